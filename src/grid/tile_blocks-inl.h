// Tiles and their blocks by vectors: included once for each SIMD target.
#if defined(FILIGREE_GRID_TILE_BLOCKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FILIGREE_GRID_TILE_BLOCKS_INL_H_
#undef FILIGREE_GRID_TILE_BLOCKS_INL_H_
#else
#define FILIGREE_GRID_TILE_BLOCKS_INL_H_
#endif

#include "grid/block.h"
#include "grid/lanes-inl.h"
#include "grid/tile_fields.h"
#include "grid/tile_patch.h"

HWY_BEFORE_NAMESPACE();
namespace filigree::grid::HWY_NAMESPACE {

// Four vertices of a patch: the blocks are x, y, z and nothing. Lanes as PatchFour says, corners clockwise
// from (0, 0).
using Four = I16;

// Lanes of a vector by what they hold of it.
struct LaneTables {
    alignas(64) std::array<int32_t, 16> lastAxis, axisBeforeLast;  // of the 0 behind z where there is none
};
inline constexpr LaneTables laneTables{{12, 12, 12, 12, 0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8},
                                       {12, 12, 12, 12, 12, 12, 12, 12, 0, 0, 0, 0, 4, 4, 4, 4}};

// Reads residuals of fours of vertices.
class ResidualReader {
  public:
    // Vertex (0, 0) of the patch stands at (x, y) of the tile's frame, and `stride` lies between its places.
    HWY_INLINE ResidualReader(const uint8_t* record, const TilePlan& plan, int32_t x, int32_t y,
                              int32_t stride)
        : plan_(plan), bits_(record + plan.bits), stride_(stride) {
        if (plan.isSheared == 0) return;
        const I16 perColumn = loadSignedBytes(plan.slopePerColumn.data());
        const I16 perRow = loadSignedBytes(plan.slopePerRow.data());
        slope_ = load(plan.slope.data()) + perColumn * all(x - 8) + perRow * all(y - 8);
        perColumn_ = perColumn * all(stride);
        perRow_ = perRow * all(stride);
    }

    HWY_INLINE Four read(unsigned four, unsigned fieldClass, unsigned drop,
                         const std::array<uint32_t, 4>& places) const {
        const I16 none = all(0), one = all(1);
        const I16 width =
            greatest(loadBytes(plan_.widths[fieldClass].data()) - all(static_cast<int32_t>(drop)), none);
        const I16 before = pick(width, none, laneTables.lastAxis.data()) +
                           pick(width, none, laneTables.axisBeforeLast.data());
        const I16 at = loadBlocks(reinterpret_cast<const int32_t*>(places.data()));
        I16 words;
        if (plan_.isNarrow != 0) {
            words =
                shiftRightBy(gatherFour(bits_, {places[0] / 8, places[1] / 8, places[2] / 8, places[3] / 8}),
                             (at & all(7)) + before);
        } else {
            const I16 bit = at + before;
            words = shiftRightBy(gather(bits_, shiftRight<3>(bit)), bit & all(7));
        }
        const I16 bias = shiftRight<3>(shiftLeftBy(loadBytes(plan_.biases[fieldClass].data()), width));
        const Four residual = (words & (shiftLeftBy(one, width) - one)) - bias;
        return plan_.isSheared == 0 ? residual : sheared(four, residual);
    }

  private:
    HWY_INLINE Four sheared(unsigned four, const Four& residual) const {
        alignas(64) std::array<int32_t, 16> kept;
        store(residual, kept.data());
        const I16 main = loadBlocks(kept.data() + size_t{4} * plan_.dominant);
        const I16 slope = slope_ + perColumn_ * loadBlocks(fourPlaces.x[four].data()) +
                          perRow_ * loadBlocks(fourPlaces.y[four].data());
        return residual + shiftRight<8>(slope * main + all(128));
    }
    static HWY_INLINE I16 loadSignedBytes(const int8_t* from) {
        const I16 bytes = loadBytes(reinterpret_cast<const uint8_t*>(from));
        return shiftRight<24>(shiftLeft<24>(bytes));
    }

    const TilePlan& plan_;
    const uint8_t* bits_;
    int32_t stride_;
    I16 slope_, perColumn_, perRow_;
};

using PatchResiduals = std::array<Four, patchFours>;

HWY_INLINE Four wrappedFour(const Four& point) {
    return point & all(latticeLimit - 1);
}
HWY_INLINE Four halfOf(const Four& p, const Four& q) {
    return shiftRight<1>(p + q + all(1));
}
// Place 2 of places 0 and 4; all bits of `thirds` are set in lanes of three steps.
HWY_INLINE Four midOf(const Four& p, const Four& q, const I16& thirds) {
    const Four third = p + shiftRight<8>(all(85) * (q - p) + all(128));
    return (third & thirds) | (halfOf(p, q) & (all(-1) - thirds));
}

// How far a line's quarters follow its bend at place 2, `curve` 32nds of it.
HWY_INLINE Four bent(const Four& two, const Four& end, const Four& other, const I16& curve) {
    return shiftRight<5>(curve * (two + two - end - other) + all(16));
}

// The vertices of a patch by fours, corners included.
struct PatchFours {
    Four corners, mids, low, high, crosses, diagonals, centre;

    HWY_INLINE PatchFours(const Four& patchCorners, const PatchResiduals& residuals, unsigned columns,
                          unsigned rows, unsigned curve)
        : corners(patchCorners) {
        const auto& r = residuals;
        const auto isThird = [](unsigned steps) { return steps == 3 ? -1 : 0; };
        const auto curveOf = [&](unsigned steps) { return static_cast<int32_t>(steps == 4 ? curve : 0); };
        alignas(16) const std::array<int32_t, 4> curves{curveOf(columns), curveOf(rows), curveOf(columns),
                                                        curveOf(rows)};
        const I16 bendAlong = loadBlocks(curves.data());
        alignas(16) const std::array<int32_t, 4> thirds{isThird(columns), isThird(rows), isThird(columns),
                                                        isThird(rows)};
        const I16 along = loadBlocks(thirds.data());
        const I16 across = turned<1, 0, 1, 0>(along);
        // Ends of the edges, from the left or the top.
        const Four from = turned<0, 1, 3, 0>(corners), to = turned<1, 2, 2, 3>(corners);
        const Four guessed = midOf(from, to, along);
        mids = wrappedFour(guessed + r[PatchFour::edgeMids]);
        const Four bend = bent(mids, from, to, bendAlong);
        low = wrappedFour(halfOf(from, mids) + bend + r[lowQuarters]);
        high = wrappedFour(halfOf(mids, to) + bend + r[highQuarters]);
        // Lane 0 from the top down, lane 3 from left to right.
        const Four between = midOf(mids, turned<2, 3, 0, 1>(mids), across);
        const Four guess = midOf(guessed, turned<2, 3, 0, 1>(guessed), across);
        const Four sum = turned<0, 0, 0, 0>(between) + turned<3, 3, 3, 3>(between);
        centre = wrappedFour(sum - turned<0, 0, 0, 0>(guess) + r[middle]);
        const Four turn = bent(centre, mids, turned<2, 3, 0, 1>(mids), turned<1, 0, 1, 0>(bendAlong));
        crosses = wrappedFour(halfOf(centre, mids) + turn + r[PatchFour::crosses]);
        setDiagonals(r[PatchFour::diagonals]);
    }

    // Vacant places repeat others.
    void storePatch(std::array<PatchAxis<int32_t>, 3>& to, unsigned columns, unsigned rows) const;
    void storeLanes(std::array<PatchAxis<int32_t>, 3>& to) const;

  private:
    // Diagonal k stands at corner k, between the edges that meet there.
    HWY_INLINE void setDiagonals(const Four& residual) {
        const auto blend = [](const Four& upper, const Four& lower) {
            alignas(16) static constexpr std::array<int32_t, 4> isUpper{-1, -1, 0, 0};
            const I16 mask = loadBlocks(isUpper.data());
            return (upper & mask) | (lower & (all(-1) - mask));
        };
        // Along edge k the quarter after its first corner and the one before its last, clockwise.
        const Four after = blend(low, high), before = blend(high, low);
        const Four beside = after + turned<3, 0, 1, 2>(before) + crosses + turned<3, 0, 1, 2>(crosses);
        const Four around = corners + mids + turned<3, 0, 1, 2>(mids) + centre;
        const Four guess = shiftRight<2>(beside + beside - around + all(2));
        diagonals = wrappedFour(guess + residual);
    }
};

// Lanes of 32 for PatchFours::storePatch.
struct RasterTables {
    alignas(
        64) std::array<int32_t, 16> centreBehind;  // of crosses and centre: what lies behind z is the centre
    alignas(64) std::array<std::array<int32_t, 16>, 3> pairs;  // [axis] of two fours: eight lanes, twice
    alignas(64) std::array<std::array<int32_t, 16>, 2> outer;  // [half] of pairs (corners, mids), (low, high)
    alignas(64)
        std::array<std::array<int32_t, 16>, 2> inner;  // [half] of what outer gave and (crosses, diagonals)
};
constexpr RasterTables rasterTablesOfPlaces() {
    RasterTables tables{};
    for (int32_t k = 0; k < 16; ++k) {
        const auto at = static_cast<size_t>(k);
        tables.centreBehind[at] = k < 12 ? k : 16 + 4 * (k - 12 < 3 ? k - 12 : 0);
        for (int32_t axis = 0; axis < 3; ++axis)
            tables.pairs[static_cast<size_t>(axis)][at] = (k % 8 / 4) * 16 + 4 * axis + k % 4;
    }
    // In the last of eight lanes of crosses and diagonals there is room behind for the centre: see
    // storePatch.
    constexpr std::array<PatchPlace, 4> cornerPlaces{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
    const auto set = [&](PatchPlace at, bool isOuter, int32_t lane) {
        const size_t place = 5U * at.y + at.x;
        if (isOuter) {
            tables.outer[place / 16][place % 16] = lane;
            tables.inner[place / 16][place % 16] = static_cast<int32_t>(place % 16);
        } else {
            tables.inner[place / 16][place % 16] = 16 + lane;
        }
    };
    for (int32_t k = 0; k < 4; ++k) {
        const auto lane = static_cast<size_t>(k);
        set(cornerPlaces[lane], true, k);
        set(placesOfFour[edgeMids][lane], true, 4 + k);
        set(placesOfFour[lowQuarters][lane], true, 16 + k);
        set(placesOfFour[highQuarters][lane], true, 20 + k);
        set(placesOfFour[crosses][lane], false, k);
        set(placesOfFour[diagonals][lane], false, 4 + k);
    }
    set({2, 2}, false, 8);
    return tables;
}
inline constexpr RasterTables rasterTables = rasterTablesOfPlaces();

// Which of the lanes that a pair of (crosses with the centre behind, diagonals) has for an axis is the
// centre.
struct InnerTables {
    alignas(64) std::array<std::array<int32_t, 16>, 3> pairs;
};
constexpr InnerTables innerTablesOfAxes() {
    InnerTables tables{};
    for (int32_t axis = 0; axis < 3; ++axis)
        for (int32_t k = 0; k < 16; ++k)
            tables.pairs[static_cast<size_t>(axis)][static_cast<size_t>(k)] =
                k == 8 ? 12 + axis : (k % 8 / 4) * 16 + 4 * axis + k % 4;
    return tables;
}
inline constexpr InnerTables innerTables = innerTablesOfAxes();

inline void PatchFours::storePatch(std::array<PatchAxis<int32_t>, 3>& to, unsigned columns,
                                   unsigned rows) const {
#if HWY_TARGET <= HWY_AVX3
    const I16 crossed = pick(crosses, centre, rasterTables.centreBehind.data());
    for (size_t axis = 0; axis < 3; ++axis) {
        const I16 first = pick(corners, mids, rasterTables.pairs[axis].data());
        const I16 second = pick(low, high, rasterTables.pairs[axis].data());
        const I16 inner = pick(crossed, diagonals, innerTables.pairs[axis].data());
        for (size_t half = 0; half < 2; ++half) {
            const I16 outer = pick(first, second, rasterTables.outer[half].data());
            store(pick(outer, inner, rasterTables.inner[half].data()), to[axis].data() + 16 * half);
        }
    }
#else
    storeLanes(to);
#endif
    if (columns == 4 && rows == 4) return;
    for (size_t axis = 0; axis < 3; ++axis)
        for (unsigned y = 0; y < 5; ++y)
            for (unsigned x = 0; x < 5; ++x)
                to[axis][5 * y + x] = to[axis][5U * vertexAtPlace[rows][y] + vertexAtPlace[columns][x]];
}

inline void PatchFours::storeLanes(std::array<PatchAxis<int32_t>, 3>& to) const {
    alignas(64) std::array<std::array<int32_t, 16>, 7> kept;
    const std::array<const Four*, 7> all{&mids, &low, &high, &crosses, &diagonals, &centre, &corners};
    for (size_t k = 0; k < 7; ++k) store(*all[k], kept[k].data());
    static constexpr std::array<PatchPlace, 4> cornerPlaces{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
    for (size_t axis = 0; axis < 3; ++axis) {
        for (size_t k = 0; k < 7; ++k)
            for (size_t lane = 0; lane < 4; ++lane) {
                const PatchPlace at = k < 6 ? placesOfFour[k][lane] : cornerPlaces[lane];
                to[axis][5U * at.y + at.x] = kept[k][4 * axis + lane];
            }
    }
}

// The tile's corners, clockwise.
inline Four tileCorners(const TileHeader& head, const uint8_t* bits) {
    alignas(64) std::array<int32_t, 16> corners{};
    uint32_t at = 0;
    const auto take = [&](unsigned width) {
        const auto field =
            static_cast<int32_t>(loadLe<uint32_t>(bits + at / 8) >> at % 8 & ((1U << width) - 1));
        at += width;
        return field - biasOf(evenBias, width);
    };
    std::array<std::array<int32_t, 3>, 3> residual{};  // right, below, last
    for (auto& corner : residual)
        for (unsigned k = 0; k < 3; ++k) corner[k] = take(head.cornerWidth[k]);
    for (unsigned k = 0; k < 3; ++k) {
        const auto base = static_cast<int32_t>(head.base[k]);
        const int32_t right = wrappedPoint(base + residual[0][k]);
        const int32_t below = wrappedPoint(base + residual[1][k]);
        corners[4 * k] = base;
        corners[4 * k + 1] = right;
        corners[4 * k + 2] = wrappedPoint(right + below - base + residual[2][k]);
        corners[4 * k + 3] = below;
    }
    return load(corners.data());
}

// Widens the boxes of the blocks' corners by what the record says.
inline void setBoxes(const uint8_t* record, const TileHeader& head, TileBlocks& tile) {
    alignas(64) std::array<int32_t, 16> lows{}, highs{};
    for (unsigned k = 0; k < 16; ++k) {
        if ((tile.blocks >> k & 1) == 0) continue;
        const unsigned i = stepsAtPlaces[head.blockColumns()][k % 4];
        const unsigned j = stepsAtPlaces[head.blockRows()][k / 4];
        const uint8_t block = record[tileHeaderBytes + j * head.blockColumns() + i];
        lows[k] = static_cast<int32_t>(lowReachOf(block));
        highs[k] = static_cast<int32_t>(highReachOf(block));
    }
    const I16 low = load(lows.data()), high = load(highs.data()), both = greatest(low, high);
    for (unsigned axis = 0; axis < 3; ++axis) {
        const I16 first = load(tile.points[axis].data()), second = load(tile.points[axis].data() + 16);
        const I16 a = pick(first, second, quadCorners.a.data()),
                  b = pick(first, second, quadCorners.b.data());
        const I16 c = pick(first, second, quadCorners.c.data()),
                  d = pick(first, second, quadCorners.d.data());
        const I16 unit = all(static_cast<int32_t>(reachUnit(head.reach[axis])));
        const bool isMain = axis == head.dominant;
        // Clamped, so that floats hold them exactly.
        const I16 least4 = least(least(a, b), least(c, d)) - unit * (isMain ? low : both);
        const I16 most4 = greatest(greatest(a, b), greatest(c, d)) + unit * (isMain ? high : both);
        store(toFloat(greatest(least4, all(0))), tile.low[axis].data());
        store(toFloat(least(most4, all(latticeLimit))), tile.high[axis].data());
    }
}

inline void decodeTileBlocks(const uint8_t* record, TileBlocks& tile) {
    const TileHeader head = loadTileHeader(record);
    tile.plan = tilePlan(record, head);
    const unsigned columns = head.blockColumns(), rows = head.blockRows();
    const ResidualReader reader(record, tile.plan, 0, 0, 4);
    PatchResiduals residuals;
    for (unsigned four = 0; four < patchFours; ++four) {
        std::array<uint32_t, 4> places{};
        for (unsigned k = 0; k < 4; ++k)
            places[k] = tile.plan.coarse + tile.plan.coarseBits * coarseFields[columns][rows][four][k];
        residuals[four] = reader.read(four, coarseClass, 0, places);
    }
    const PatchFours fours(tileCorners(head, record + tile.plan.bits), residuals, columns, rows, 0);
    fours.storePatch(tile.points, columns, rows);
    tile.blocks = stepMask(columns, rows);
    setBoxes(record, head, tile);
}

// The corners of a block, clockwise; `first` is where the first stands.
HWY_INLINE Four blockCorners(const TileBlocks& tile, unsigned first) {
    alignas(64) std::array<int32_t, 16> corners{};
    for (unsigned k = 0; k < 3; ++k) {
        corners[4 * k] = tile.points[k][first];
        corners[4 * k + 1] = tile.points[k][first + 1];
        corners[4 * k + 2] = tile.points[k][first + 6];
        corners[4 * k + 3] = tile.points[k][first + 5];
    }
    return load(corners.data());
}

inline uint32_t diagonalsOf(const uint8_t* record, unsigned number, const Block& block, unsigned columns,
                            unsigned rows) {
    const TileHeader head = loadTileHeader(record);
    const uint32_t stored = loadLe<uint16_t>(record + tileParts(head).diagonals + size_t{2} * number);
    uint32_t bd = 0;
    for (unsigned k = 0; k < 16; ++k) {
        if ((block.quads >> k & 1) == 0) continue;
        const unsigned x = stepsAtPlaces[columns][k % 4], y = stepsAtPlaces[rows][k / 4];
        bd |= (stored >> (4 * y + x) & 1) << k;
    }
    return bd;
}

// `place`: bit of TileBlocks::blocks.
inline void decodeTileBlock(const uint8_t* record, const TileBlocks& tile, unsigned place, Block& block) {
    const TilePlan& plan = tile.plan;
    const unsigned i = stepsAtPlaces[blocksOf(plan.columns)][place % 4];
    const unsigned j = stepsAtPlaces[blocksOf(plan.rows)][place / 4];
    const unsigned columns = stepsOfBlock(plan.columns, i), rows = stepsOfBlock(plan.rows, j);
    const unsigned number = j * blocksOf(plan.columns) + i;
    FieldPlaces places;
    setEdgePlaces(plan, i, j, places);
    setInsidePlaces(plan, number, columns, rows, places);
    const ResidualReader reader(record, plan, static_cast<int32_t>(4 * i), static_cast<int32_t>(4 * j), 1);
    PatchResiduals residuals;
    for (unsigned four = 0; four < patchFours; ++four)
        residuals[four] = reader.read(four, classOfFour[four],
                                      four < crosses ? 0 : dropOf(plan.drops[number]), places[four]);
    const PatchFours fours(blockCorners(tile, place / 4 * 5 + place % 4), residuals, columns, rows,
                           plan.curve);
    alignas(64) std::array<PatchAxis<int32_t>, 3> points;
    fours.storePatch(points, columns, rows);
    for (size_t k = 0; k < 3; ++k) {
        store(toFloat(load(points[k].data())), block.points[k].data());
        store(toFloat(load(points[k].data() + 16)), block.points[k].data() + 16);
    }
    block.quads = stepMask(columns, rows);
    const auto diagonals = static_cast<TileDiagonals>(fieldOf(loadLe<uint32_t>(record + 4), 24, 2));
    block.bd = diagonals == TileDiagonals::allBd ? 0xffff : 0;
    if (diagonals == TileDiagonals::mixed) block.bd = diagonalsOf(record, number, block, columns, rows);
}

}  // namespace filigree::grid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
