#include "grid/assemble.h"

#include <algorithm>
#include <cassert>

namespace filigree::grid {
namespace {

// A quad in the frame of its grid.
struct UprightQuad {
    std::array<uint32_t, 4> corners{};  // a b c d
    std::array<uint32_t, 2> sources{};
    Diagonal diagonal = Diagonal::ac;
};

// A quad added at `side` stands in its own frame turned by so many quarters: its a is the grid's corner of
// that number (a b c d).
constexpr size_t turnsAt(Side side) {
    constexpr std::array<size_t, sideCount> quarters{2, 3, 0, 1};
    return quarters[static_cast<size_t>(side)];
}

UprightQuad uprightQuad(const Topology& topology, const PlacedQuad& quad, Side side, bool turnQuads) {
    QuadParts parts;
    [[maybe_unused]] const bool stands = partsOf(topology, quad, parts);
    assert(stands);
    const std::array<uint32_t, 4> own{topology.from(quad.edge), topology.from(nextEdge(quad.edge)), parts.c,
                                      parts.d};
    const size_t quarters = turnsAt(side);
    UprightQuad result;
    for (size_t k = 0; k < 4; ++k) result.corners[(k + quarters) % 4] = own[k];
    result.diagonal = (quarters % 2 == 1) != quad.bd ? Diagonal::bd : Diagonal::ac;
    const uint32_t first = quad.edge / 3;
    if (turnQuads && topology.diagonal[first] != noCorner) {
        result.diagonal = Diagonal::ac;
        result.sources = {std::min(first, parts.second), std::max(first, parts.second)};
        return result;
    }
    // The first half holds b where the diagonal is ac, a where it is bd.
    const size_t apart = result.diagonal == Diagonal::ac ? 1 : 0;
    const auto& vertices = topology.triangles[first];
    const bool firstHolds = std::ranges::find(vertices, result.corners[apart]) != vertices.end();
    result.sources = {firstHolds ? first : parts.second, firstHolds ? parts.second : first};
    return result;
}

class GridAssembly {
  public:
    GridAssembly(const mesh::FaceMesh& mesh, const Topology& topology, const Choice& choice,
                 const ConvertOptions& options)
        : mesh_(mesh),
          topology_(topology),
          choice_(choice),
          turnQuads_(options.turnQuads),
          withNormals_(options.attributes && !mesh.normals.empty()),
          withUvs_(options.attributes && !mesh.uvs.empty()) {}

    GridMesh make(const Executor& executor) {
        reserve();
        executor.parallelFor(choice_.grids.size(), 1, [&](size_t begin, size_t end) {
            for (size_t g = begin; g < end; ++g) fill(choice_.grids[g], out_.grids[g]);
        });
        if (std::ranges::all_of(out_.diagonals, [](Diagonal d) { return d == Diagonal::ac; }))
            out_.diagonals.clear();
        addLoose();
        return std::move(out_);
    }

  private:
    void reserve() {
        uint64_t vertices = 0;
        uint64_t quads = 0;
        for (const GrownGrid& grown : choice_.grids) {
            const VertexGrid grid{grown.columns + 1, grown.rows + 1, vertices, quads};
            vertices += grid.vertexCount();
            quads += grid.quadCount();
            out_.grids.push_back(grid);
        }
        out_.vertices.resize(vertices);
        out_.diagonals.resize(quads);
        out_.quadSources.resize(quads);
        if (withNormals_) out_.normals.resize(vertices);
        if (withUvs_) out_.uvs.resize(vertices);
    }

    // Walks the lines as they were added, around the rectangle that stood before each.
    void fill(const GrownGrid& grown, const VertexGrid& grid) {
        std::array<uint32_t, sideCount> added{};  // lines at each side
        for (size_t l = 1; l < grown.lines.size(); ++l) ++added[static_cast<size_t>(grown.lines[l].side)];
        // The rectangle, [low, high) in quads.
        uint32_t lowColumn = added[static_cast<size_t>(Side::left)];
        uint32_t lowRow = added[static_cast<size_t>(Side::bottom)];
        uint32_t highColumn = lowColumn + 1;
        uint32_t highRow = lowRow;
        for (size_t l = 0; l < grown.lines.size(); ++l) {
            const Side side = grown.lines[l].side;
            const uint64_t first = grown.lines[l].first;
            const auto quad = [&](uint32_t k) {
                return uprightQuad(topology_, grown.quads[first + k], side, turnQuads_);
            };
            const uint32_t along =
                side == Side::top || side == Side::bottom ? highColumn - lowColumn : highRow - lowRow;
            if (side == Side::bottom) --lowRow;
            if (side == Side::left) --lowColumn;
            for (uint32_t k = 0; k < along; ++k) {
                switch (side) {
                    case Side::bottom:
                        put(grid, lowColumn + k, lowRow, quad(k));
                        break;
                    case Side::right:
                        put(grid, highColumn, lowRow + k, quad(k));
                        break;
                    case Side::top:
                        put(grid, highColumn - 1 - k, highRow, quad(k));
                        break;
                    case Side::left:
                        put(grid, lowColumn, highRow - 1 - k, quad(k));
                        break;
                }
            }
            if (side == Side::right) ++highColumn;
            if (side == Side::top) ++highRow;
        }
    }

    void put(const VertexGrid& grid, uint32_t column, uint32_t row, const UprightQuad& quad) {
        const uint64_t at = grid.firstQuad + uint64_t{row} * (grid.columns - 1) + column;
        out_.diagonals[at] = quad.diagonal;
        out_.quadSources[at] = quad.sources;
        const uint64_t low = grid.firstVertex + uint64_t{row} * grid.columns + column;
        const uint64_t high = low + grid.columns;
        putVertex(low, quad.corners[0]);
        putVertex(low + 1, quad.corners[1]);
        putVertex(high + 1, quad.corners[2]);
        putVertex(high, quad.corners[3]);
    }

    void putVertex(uint64_t at, uint32_t vertex) {
        out_.vertices[at] = mesh_.positions[vertex];
        if (withNormals_) out_.normals[at] = mesh_.normals[vertex];
        if (withUvs_) out_.uvs[at] = mesh_.uvs[vertex];
    }

    void addLoose() {
        std::vector<uint32_t> numbers(mesh_.positions.size(), mesh::noVertex);
        for (const uint32_t t : choice_.loose) {
            std::array<uint32_t, 3> triangle{};
            for (size_t k = 0; k < 3; ++k) triangle[k] = looseNumber(topology_.triangles[t][k], numbers);
            out_.looseTriangles.push_back(triangle);
            out_.looseSources.push_back(t);
        }
    }

    uint32_t looseNumber(uint32_t vertex, std::vector<uint32_t>& numbers) {
        if (numbers[vertex] == mesh::noVertex) {
            numbers[vertex] = static_cast<uint32_t>(out_.looseVertices.size());
            out_.looseVertices.push_back(mesh_.positions[vertex]);
            if (withNormals_) out_.looseNormals.push_back(mesh_.normals[vertex]);
            if (withUvs_) out_.looseUvs.push_back(mesh_.uvs[vertex]);
        }
        return numbers[vertex];
    }

    const mesh::FaceMesh& mesh_;
    const Topology& topology_;
    const Choice& choice_;
    bool turnQuads_;
    bool withNormals_;
    bool withUvs_;
    GridMesh out_;
};

}  // namespace

GridMesh assemble(const mesh::FaceMesh& mesh, const Topology& topology, const Choice& choice,
                  const ConvertOptions& options, const Executor& executor) {
    return GridAssembly(mesh, topology, choice, options).make(executor);
}

}  // namespace filigree::grid
