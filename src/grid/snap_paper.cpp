#include "grid/snap_paper.h"

#include "grid/shared_places.h"
#include "grid/sub_grids.h"

#include <algorithm>

namespace filigree::grid {
namespace {

// Into what a sub-grid is cut.
enum class Cut : uint8_t { none, columns, rows, quads };

class PaperSnapper {
  public:
    PaperSnapper(const GridMesh& mesh, std::span<const PaperPlace> places, const PaperCode& paper,
                 const Lattice& lattice, const Executor& executor)
        : mesh_(mesh),
          places_(places),
          paper_(paper),
          lattice_(lattice),
          executor_(executor),
          targets_(mesh.vertices),
          mustBeCorner_(mesh.vertices.size()) {}

    SnappedPaper run() {
        moveToLattice();
        const std::vector<Vec3> uncut = decode(places_, targets_);
        std::vector<Vec3> decoded = uncut;
        SnappedPaper snapped{{places_.begin(), places_.end()}, targets_};
        // Cuts move inner vertices, which may be shared as well in odd meshes. Marks only grow.
        while (markCracks(decoded)) {
            snapped = cutPlaces(uncut);
            decoded = decode(snapped.places, snapped.vertices);
        }
        return snapped;
    }

  private:
    // Vertices that loose triangles share stand where those decode to.
    void moveToLattice() {
        forEachShared(mesh_, [&](std::span<const MeshPlace> places) {
            if (!places.back().isLoose) return;
            const Vec3 moved = onLattice(places[0]);
            for (const MeshPlace& place : places) {
                if (!place.isLoose) targets_[place.index] = moved;
            }
        });
    }
    [[nodiscard]] Vec3 onLattice(const MeshPlace& place) const {
        return lattice_.positionOf(lattice_.pointAt(mesh_.vertices[place.index]));
    }

    // Marks the positions that decode to several points; whether any was new.
    bool markCracks(std::span<const Vec3> decoded) {
        bool isNew = false;
        forEachShared(mesh_, [&](std::span<const MeshPlace> places) {
            const Vec3 wanted = places.back().isLoose ? onLattice(places[0]) : decoded[places[0].index];
            const bool agree = std::ranges::all_of(places, [&](const MeshPlace& place) {
                return place.isLoose || decoded[place.index] == wanted;
            });
            if (agree) return;
            for (const MeshPlace& place : places) {
                if (place.isLoose || mustBeCorner_[place.index]) continue;
                mustBeCorner_[place.index] = true;
                isNew = true;
            }
        });
        return isNew;
    }

    [[nodiscard]] Cut cutOf(const PaperPlace& place) const {
        const VertexGrid& grid = mesh_.grids[place.grid];
        bool needsColumns = false;
        bool needsRows = false;
        for (unsigned row = 0; row <= place.rows; ++row) {
            for (unsigned column = 0; column <= place.columns; ++column) {
                if (!mustBeCorner_[vertexOf(grid, place, column, row)]) continue;
                needsColumns = needsColumns || column % place.columns != 0;
                needsRows = needsRows || row % place.rows != 0;
            }
        }
        if (needsColumns && needsRows) return Cut::quads;
        return needsColumns ? Cut::columns : needsRows ? Cut::rows : Cut::none;
    }

    [[nodiscard]] SnappedPaper cutPlaces(std::span<const Vec3> uncut) const {
        SnappedPaper snapped{{}, targets_};
        for (const PaperPlace& place : places_) {
            const Cut cut = cutOf(place);
            const unsigned columns = cut == Cut::columns || cut == Cut::quads ? 1 : place.columns;
            const unsigned rows = cut == Cut::rows || cut == Cut::quads ? 1 : place.rows;
            for (unsigned row = 0; row < place.rows; row += rows) {
                for (unsigned column = 0; column < place.columns; column += columns) {
                    PaperPlace piece = place;
                    piece.gridColumn += column;
                    piece.gridRow += row;
                    piece.columns = columns;
                    piece.rows = rows;
                    snapped.places.push_back(piece);
                    if (cut != Cut::none) keepCorners(piece, uncut, snapped.vertices);
                }
            }
        }
        return snapped;
    }

    // What the neighbours may hold as displaced vertices stays where it was decoded.
    void keepCorners(const PaperPlace& piece, std::span<const Vec3> uncut,
                     std::vector<Vec3>& vertices) const {
        for (const unsigned row : {0U, piece.rows}) {
            for (const unsigned column : {0U, piece.columns}) {
                const uint64_t k = vertexOf(mesh_.grids[piece.grid], piece, column, row);
                if (!mustBeCorner_[k]) vertices[k] = uncut[k];
            }
        }
    }

    [[nodiscard]] std::vector<Vec3> decode(std::span<const PaperPlace> places,
                                           std::span<const Vec3> vertices) const {
        std::vector<Vec3> decoded(vertices.size());
        executor_.parallelFor(places.size(), 256, [&](size_t begin, size_t end) {
            for (size_t k = begin; k < end; ++k) decodeOne(places[k], vertices, decoded);
        });
        return decoded;
    }
    void decodeOne(const PaperPlace& place, std::span<const Vec3> vertices, std::vector<Vec3>& to) const {
        const VertexGrid& grid = mesh_.grids[place.grid];
        const auto record = encodePaper(place, subGridVertices(vertices, grid, place), paper_);
        const PaperVertices decoded = decodePaper(record.data(), paper_);
        const unsigned columns = ownVertices(place.gridColumn, place.columns, place.gridColumns);
        for (unsigned row = 0; row < ownVertices(place.gridRow, place.rows, place.gridRows); ++row)
            std::copy_n(&decoded[row * paperSide], columns, &to[vertexOf(grid, place, 0, row)]);
    }

    const GridMesh& mesh_;
    std::span<const PaperPlace> places_;
    PaperCode paper_;
    Lattice lattice_;
    const Executor& executor_;
    std::vector<Vec3> targets_;
    std::vector<bool> mustBeCorner_;
};

}  // namespace

SnappedPaper snapPaper(const GridMesh& mesh, std::span<const PaperPlace> places, const PaperCode& paper,
                       const Lattice& lattice, const Executor& executor) {
    return PaperSnapper(mesh, places, paper, lattice, executor).run();
}

}  // namespace filigree::grid
