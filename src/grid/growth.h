// One grid grown from one quad.
#pragma once

#include "filigree/core/vec3.h"

#include "grid/topology.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::grid {

// A quad of two triangles in its own frame: corners a b c d, `edge` is the half-edge a -> b.
struct PlacedQuad {
    uint32_t edge = noEdge;
    bool bd = false;  // the diagonal; otherwise ac
};

// The half-edges of a quad and its other two corners.
struct QuadParts {
    uint32_t right = noEdge;  // b -> c
    uint32_t top = noEdge;    // c -> d
    uint32_t left = noEdge;   // d -> a
    uint32_t c = 0;
    uint32_t d = 0;
    uint32_t second = 0;  // the triangle that does not hold `edge`
};

// False where the two triangles do not stand there.
bool partsOf(const Topology& topology, const PlacedQuad& quad, QuadParts& parts);

// Sides in the order around a grid: low row, high column, high row, low column.
enum class Side : uint8_t { bottom, right, top, left };
inline constexpr size_t sideCount = 4;
constexpr Side sideAfter(Side side) {
    return static_cast<Side>((static_cast<size_t>(side) + 1) % sideCount);
}
constexpr Side sideBefore(Side side) {
    return static_cast<Side>((static_cast<size_t>(side) + sideCount - 1) % sideCount);
}

// A row or column added at one side, its quads in the order around the grid, each in the frame in which its
// edge a -> b lies on what was there before. The first line is the seed, upright, as if at the top.
struct Line {
    Side side = Side::top;
    uint64_t first = 0;  // into quads
};

struct GrownGrid {
    uint32_t columns = 0;  // quads
    uint32_t rows = 0;
    std::vector<Line> lines;
    std::vector<PlacedQuad> quads;

    [[nodiscard]] uint64_t quadCount() const { return quads.size(); }
};

// Which sides grow first.
enum class GrowthOrder : uint8_t { inTurn, columnsFirst, rowsFirst };

// Which quads may stand in one grid.
struct GrowthRules {
    bool uniformDiagonals = false;  // those with the seed's diagonal
    bool turnQuads = false;         // and quads of the mesh, which take the seed's
};

class Growth {
  public:
    Growth(const Topology& topology, std::span<const Vec3> positions, const GrowthRules& rules);

    // The largest rectangle of free triangles that whole rows and columns around the quad over half-edge
    // `diagonal` give; no quads where there is none. What must stay one quad wide is given up on the way.
    // Stays until the next call.
    const GrownGrid& grow(uint32_t diagonal, GrowthOrder order);

    // Takes the triangles of a grid for good.
    void take(const GrownGrid& grid);
    void take(uint32_t triangle) { marks_[triangle] = taken; }
    [[nodiscard]] bool isFree(uint32_t triangle) const { return marks_[triangle] != taken; }

  private:
    static constexpr uint32_t taken = 0xffffffff;

    // An edge of the border, in the direction around the grid, with the vertices before its two in the grid.
    struct BorderEdge {
        uint32_t edge = noEdge;
        uint32_t beforeFrom = 0;
        uint32_t beforeTo = 0;
    };
    // Grows at both ends.
    struct Border {
        std::vector<BorderEdge> front;  // backwards
        std::vector<BorderEdge> back;
        void clear();
        void copyTo(std::vector<BorderEdge>& all) const;
    };
    // A line that may be added.
    struct Trial {
        std::vector<PlacedQuad> quads;
        std::vector<QuadParts> parts;
    };

    void beginEpoch();
    bool seed(uint32_t diagonal);
    [[nodiscard]] bool isStrip() const;
    bool growSide(Side side);
    bool growInTurn(std::span<const Side> sides);
    bool sweep(Side side, bool firstIsBd, Trial& trial);
    [[nodiscard]] bool breaksRules(Side side, const PlacedQuad& quad) const;
    bool sweepOne(Side side, size_t at, bool firstIsBd, Trial& trial);
    void unmark(const Trial& trial);
    double bend(const Trial& trial) const;
    void add(Side side, const Trial& trial);
    [[nodiscard]] bool isUnmarked(uint32_t triangle) const {
        return marks_[triangle] != taken && marks_[triangle] != epoch_;
    }
    uint32_t& countAlong(Side side);

    const Topology& topology_;
    std::span<const Vec3> positions_;
    GrowthRules rules_;
    std::vector<uint32_t> marks_;  // [triangle_count]: taken, or the growth that last held it
    uint32_t epoch_ = 0;
    GrownGrid grid_;
    std::array<Border, sideCount> borders_;
    std::array<bool, sideCount> blocked_{};
    std::vector<BorderEdge> border_;  // of the side that grows
    std::array<Trial, 2> trials_;
};

}  // namespace filigree::grid
