// The codec `paper`: 128-byte sub-grids of 5 x 5 vertices, a bilinear patch with 21 displacements of 24 bits
// (Benthin, Vaidyanathan and Woop 2021, section 4 and listing 1; docs/spec/paper.md).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/bytes.h"
#include "filigree/core/result.h"
#include "filigree/core/vec3.h"
#include "filigree/grid/vertex_grid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace filigree::grid {

// Sizes of a record and of the sub-grid in it.
inline constexpr size_t paperBytes = 128;
inline constexpr unsigned paperQuads = 4;  // along a side, at most
inline constexpr unsigned paperSide = 5;   // vertices along a side
inline constexpr unsigned paperSlots = 21;

// Where a record's fields begin, in bytes.
inline constexpr size_t paperSlotsAt = 48;  // after four corners of three floats
inline constexpr size_t paperSizeAt = 111;
inline constexpr size_t paperObjectAt = 112;
inline constexpr size_t paperGridAt = 116;
inline constexpr size_t paperPlaceAt = 120;  // gridX, gridY, gridResX, gridResY

// What the 24 bits of a displacement mean (section 4.1).
enum class DisplacementCode : uint8_t {
    unitVector,      // octant : 3, unit vector : 10, exponent : 6, mantissa : 5, from the top
    sharedExponent,  // octant : 3, exponent : 6, three mantissas of 5 bits, x first
};
// The names of the command line, and the way back.
FILIGREE_API std::string_view nameOf(DisplacementCode code);  // "unit-vector", "shared-exponent"
FILIGREE_API std::optional<DisplacementCode> displacementCodeNamed(std::string_view name);

// One for all sub-grids of a scene. Exponent field e stands for 2^(e + exponentBase - 127).
struct FILIGREE_API PaperCode {
    DisplacementCode displacement = DisplacementCode::unitVector;
    uint8_t exponentBase = 96;
    bool operator==(const PaperCode&) const = default;

    static constexpr uint8_t leastBase = 5;
    static constexpr uint8_t mostBase = 190;

    // The base whose greatest exponent just holds any displacement inside a box of that diagonal.
    static PaperCode forDiagonal(DisplacementCode displacement, float diagonal);
};

// The 1024 unit vectors of the first octant, as docs/spec/paper.md makes them.
struct UnitVectors {
    alignas(64) std::array<float, 1024> x;
    alignas(64) std::array<float, 1024> y;
    alignas(64) std::array<float, 1024> z;
};
FILIGREE_API const UnitVectors& unitVectors();

// Weight of the near and the far corner at vertex i of a side of `quads` quads; past its end those of the
// end. The two mirror each other, so that an edge gives the same points run from either end.
inline constexpr std::array<std::array<float, paperSide>, paperSide> paperFar{{
    {},
    {0, 1, 1, 1, 1},
    {0, 0.5F, 1, 1, 1},
    {0, 1.0F / 3, 2.0F / 3, 1, 1},
    {0, 0.25F, 0.5F, 0.75F, 1},
}};
inline constexpr std::array<std::array<float, paperSide>, paperSide> paperNear{{
    {},
    {1, 0, 0, 0, 0},
    {1, 0.5F, 0, 0, 0},
    {1, 2.0F / 3, 1.0F / 3, 0, 0},
    {1, 0.75F, 0.5F, 0.25F, 0},
}};

// The slot of the displacement of vertex (column, row), none for the four places that have none.
constexpr std::optional<unsigned> paperSlot(unsigned column, unsigned row) {
    const unsigned place = row * paperSide + column;
    if (column % 4 == 0 && row % 4 == 0) return std::nullopt;
    return place - (place < 4 ? 1 : place < 20 ? 2 : 3);
}

// A sub-grid of columns x rows quads whose first quad is (gridColumn, gridRow) of its grid.
struct PaperPlace {
    unsigned columns = 0;  // quads, 1 to 4
    unsigned rows = 0;     // the same
    Diagonal diagonal = Diagonal::ac;
    uint32_t grid = 0;
    unsigned gridColumn = 0;
    unsigned gridRow = 0;
    unsigned gridColumns = 0;  // quads of the grid, 1 to 65535
    unsigned gridRows = 0;
    bool operator==(const PaperPlace&) const = default;
};

// Vertex (column, row) at row * 5 + column. Past the sub-grid's quads they mean nothing.
using PaperVertices = std::array<Vec3, paperSide * paperSide>;

// The points of the patch, without displacements. `columns` and `rows` are 1 to 4.
FILIGREE_API PaperVertices paperPatch(const std::array<Vec3, 4>& corners, unsigned columns, unsigned rows);

// What the codec adds to the patch for a code of 24 bits.
FILIGREE_API Vec3 displacementOf(uint32_t code, const PaperCode& paper);

// Any 128 bytes decode to something; meaningful where checkPaper() finds nothing.
inline uint32_t paperSlotCode(const uint8_t* record, unsigned slot) {
    return loadLe<uint32_t>(record + paperSlotsAt + size_t{3} * slot) & 0xffffff;
}
FILIGREE_API std::array<Vec3, 4> paperCorners(
    const uint8_t* record);  // near near, far near, near far, far far
// What a record says of its place, and its decoded vertices.
FILIGREE_API PaperPlace paperPlace(const uint8_t* record);
FILIGREE_API PaperVertices decodePaper(const uint8_t* record, const PaperCode& paper);

// What a record must keep so that it can be traced: sizes and place, fields that must be zero, finite
// vertices.
FILIGREE_API Status checkPaper(std::span<const uint8_t, paperBytes> record, const PaperCode& paper);

// The code whose decoded vertex, the patch point `base` plus the displacement, is nearest to `target`.
FILIGREE_API uint32_t encodeDisplacement(const Vec3& base, const Vec3& target, const PaperCode& paper);

// Encodes `vertices`, of which the four at the corners of the quads are kept exactly. All finite.
FILIGREE_API std::array<uint8_t, paperBytes> encodePaper(const PaperPlace& place,
                                                         const PaperVertices& vertices,
                                                         const PaperCode& paper);

}  // namespace filigree::grid
