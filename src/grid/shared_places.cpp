#include "grid/shared_places.h"

#include <algorithm>
#include <bit>

namespace filigree::grid {
namespace {

std::array<uint32_t, 3> bitsOf(const Vec3& position) {
    std::array<uint32_t, 3> bits{};
    for (size_t axis = 0; axis < 3; ++axis) bits[axis] = std::bit_cast<uint32_t>(position[axis] + 0.0F);
    return bits;
}

// Whether a position may have been put in; wrong yes now and then, never wrong no.
class MaybeSeen {
  public:
    explicit MaybeSeen(size_t positions)
        : shift_(64 - static_cast<unsigned>(std::bit_width(positions * 16 + 64))),
          bits_(size_t{1} << (64 - shift_)) {}
    void put(const std::array<uint32_t, 3>& position) { bits_[slotOf(position)] = true; }
    [[nodiscard]] bool has(const std::array<uint32_t, 3>& position) const { return bits_[slotOf(position)]; }

  private:
    [[nodiscard]] size_t slotOf(const std::array<uint32_t, 3>& position) const {
        uint64_t hash = 0;
        for (const uint32_t bits : position) hash = (std::rotl(hash, 23) ^ bits) * 0x9e3779b97f4a7c15;
        return hash >> shift_;
    }
    unsigned shift_;
    std::vector<bool> bits_;
};

bool isBorder(const VertexGrid& grid, uint32_t column, uint32_t row) {
    return column == 0 || row == 0 || column + 1 == grid.columns || row + 1 == grid.rows;
}

// body(vertex index, whether it lies on its grid's border).
template <class Body>
void forEachGridVertex(const GridMesh& mesh, const Body& body) {
    for (const VertexGrid& grid : mesh.grids) {
        uint64_t at = grid.firstVertex;
        for (uint32_t row = 0; row < grid.rows; ++row) {
            for (uint32_t column = 0; column < grid.columns; ++column, ++at)
                body(at, isBorder(grid, column, row));
        }
    }
}

// One place of each loose vertex that is used.
std::vector<MeshPlace> loosePlaces(const GridMesh& mesh) {
    std::vector<MeshPlace> places;
    std::vector<bool> seen(mesh.looseVertices.size());
    for (uint64_t corner = 0; corner < 3 * mesh.looseTriangles.size(); ++corner) {
        const uint32_t vertex = mesh.looseTriangles[corner / 3][corner % 3];
        if (seen[vertex]) continue;
        seen[vertex] = true;
        places.push_back({bitsOf(mesh.looseVertices[vertex]), true, corner});
    }
    return places;
}

// Borders of grids, loose corners, and inner vertices at one of their positions; sorted.
std::vector<MeshPlace> candidates(const GridMesh& mesh) {
    std::vector<MeshPlace> places = loosePlaces(mesh);
    forEachGridVertex(mesh, [&](uint64_t vertex, bool border) {
        if (border) places.push_back({bitsOf(mesh.vertices[vertex]), false, vertex});
    });
    MaybeSeen seen(places.size());
    for (const MeshPlace& place : places) seen.put(place.position);
    forEachGridVertex(mesh, [&](uint64_t vertex, bool border) {
        if (border) return;
        const auto position = bitsOf(mesh.vertices[vertex]);
        if (seen.has(position)) places.push_back({position, false, vertex});
    });
    std::ranges::sort(places);
    return places;
}

}  // namespace

void forEachShared(const GridMesh& mesh, const std::function<void(std::span<const MeshPlace>)>& visit) {
    std::vector<MeshPlace> places = candidates(mesh);
    // Grids' vertices sort before loose corners; one of those is enough.
    const auto isSurplus = [](const MeshPlace& a, const MeshPlace& b) {
        return a.position == b.position && a.isLoose && b.isLoose;
    };
    places.erase(std::unique(places.begin(), places.end(), isSurplus), places.end());
    for (size_t begin = 0; begin < places.size();) {
        size_t end = begin + 1;
        while (end < places.size() && places[end].position == places[begin].position) ++end;
        if (end - begin > 1 && !places[begin].isLoose) visit(std::span(places).subspan(begin, end - begin));
        begin = end;
    }
}

}  // namespace filigree::grid
