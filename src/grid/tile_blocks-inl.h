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

// Of four lanes, in every block.
struct FourLanes {
    alignas(16) std::array<int32_t, 4> of;
    [[nodiscard]] HWY_INLINE I16 all() const { return loadBlocks(of.data()); }
};
inline constexpr FourLanes axisFields{{31, 31, 31, 0}};
inline constexpr FourLanes behindFirst{{0, -1, -1, -1}};
inline constexpr FourLanes behindSecond{{0, 0, -1, -1}};
inline constexpr FourLanes diagonalShifts{{0, 5, 10, 0}};
inline constexpr std::array<FourLanes, 3> onAxis{{{{-1, 0, 0, 0}}, {{0, -1, 0, 0}}, {{0, 0, -1, 0}}}};

// The fields of a vertex on the axes, x, y, z and nothing in every block of the vectors.
struct VertexFields {
    I16 width, bias;
    unsigned bits;  // all together
};

// Reads residuals of fours of vertices.
class ResidualReader {
  public:
    // Vertex (0, 0) of the patch stands at (x, y) of the tile's frame, and `stride` lies between its places.
    HWY_INLINE ResidualReader(const uint8_t* record, const TilePlan& plan, int32_t x, int32_t y,
                              int32_t stride)
        : plan_(plan),
          bits_(record + plan.bits),
          words_(loadBlocks(reinterpret_cast<const int32_t*>(record + 20))),
          diagonalWord_(loadLe<uint32_t>(record + 32)),
          shear_(loadLe<uint32_t>(record + 36)),
          dominant_(fieldOf(loadLe<uint32_t>(record + 4), 26, 2)) {
        if (shear_ == 0) return;
        const auto minors = minorAxes(dominant_);
        alignas(16) std::array<int32_t, 4> slope{}, perColumn{}, perRow{};
        for (unsigned m = 0; m < 2; ++m) {
            perColumn[minors[m]] = signedFieldOf(shear_, 16 * m + 6, 5);
            perRow[minors[m]] = signedFieldOf(shear_, 16 * m + 11, 5);
            slope[minors[m]] = 8 * signedFieldOf(shear_, 16 * m, 6) + perColumn[minors[m]] * (x - 8) +
                               perRow[minors[m]] * (y - 8);
            perColumn[minors[m]] *= stride;
            perRow[minors[m]] *= stride;
        }
        slope_ = spread(loadBlocks(slope.data()));
        perColumn_ = spread(loadBlocks(perColumn.data()));
        perRow_ = spread(loadBlocks(perRow.data()));
    }

    // Of fields without a class, at `field` of words 5 to 7.
    [[nodiscard]] HWY_INLINE VertexFields fieldsAt(unsigned field) const {
        const I16 width = shiftRightBy(words_, all(static_cast<int32_t>(field))) & axisFields.all();
        return {width, shiftRight<3>(shiftLeftBy(axisFields.all() & all(4), width)),
                plan_.vertexBitsAt(field)};
    }
    [[nodiscard]] HWY_INLINE VertexFields fieldsOf(ResidualClass c, unsigned drop) const {
        const I16 wide = c == insideDiagonal
                             ? shiftRightBy(all(static_cast<int32_t>(diagonalWord_)), diagonalShifts.all())
                             : shiftRightBy(words_, all(static_cast<int32_t>(fieldOfClass(c))));
        const I16 width = greatest((wide & axisFields.all()) - all(static_cast<int32_t>(drop)), all(0));
        const auto more = static_cast<int32_t>(fieldOf(diagonalWord_, 15 + 3 * c, 3)) - 4;
        const I16 bias = (axisFields.all() & all(4)) + (onAxis[dominant_].all() & all(more));
        return {width, shiftRight<3>(shiftLeftBy(bias, width)), plan_.vertexBitsOf(c, drop)};
    }

    // The vertices whose fields begin at `places`, the same in every block.
    HWY_INLINE Four read(unsigned four, const VertexFields& fields, const I16& places) const {
        const Four residual = readPlain(fields, places);
        return shear_ == 0 ? residual : sheared(four, residual);
    }
    HWY_INLINE Four readPlain(const VertexFields& fields, const I16& places) const {
        const I16& width = fields.width;
        const I16 before = spread((turned<0, 0, 1, 2>(width) & behindFirst.all()) +
                                  (turned<0, 0, 0, 1>(width) & behindSecond.all()));
        const I16 mask = spread(shiftLeftBy(all(1), width) - all(1));
        I16 words;
        if (fields.bits <= 25) {
            // With up to 7 bits before them in one word.
            words = shiftRightBy(gatherFour(bits_, shiftRight<3>(places)), (places & all(7)) + before);
        } else {
            const I16 bit = places + before;
            words = shiftRightBy(gather(bits_, shiftRight<3>(bit)), bit & all(7));
        }
        return (words & mask) - spread(fields.bias);
    }

  private:
    HWY_INLINE Four sheared(unsigned four, const Four& residual) const {
        alignas(64) std::array<int32_t, 16> kept;
        store(residual, kept.data());
        const I16 main = loadBlocks(kept.data() + size_t{4} * dominant_);
        const I16 slope = slope_ + perColumn_ * loadBlocks(fourPlaces.x[four].data()) +
                          perRow_ * loadBlocks(fourPlaces.y[four].data());
        return residual + shiftRight<8>(slope * main + all(128));
    }

    const TilePlan& plan_;
    const uint8_t* bits_;
    I16 words_;  // 5 to 8
    uint32_t diagonalWord_;
    uint32_t shear_;
    unsigned dominant_;
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

    // Of 4 x 4 steps.
    HWY_INLINE PatchFours(const Four& patchCorners, const PatchResiduals& residuals, unsigned curve)
        : corners(patchCorners) {
        const I16 bend = all(static_cast<int32_t>(curve));
        predict<true>(residuals, bend, bend, all(0), all(0));
    }
    HWY_INLINE PatchFours(const Four& patchCorners, const PatchResiduals& residuals, unsigned columns,
                          unsigned rows, unsigned curve)
        : corners(patchCorners) {
        const auto isThird = [](unsigned steps) { return steps == 3 ? -1 : 0; };
        const auto curveOf = [&](unsigned steps) { return static_cast<int32_t>(steps == 4 ? curve : 0); };
        alignas(16) const std::array<int32_t, 4> curves{curveOf(columns), curveOf(rows), curveOf(columns),
                                                        curveOf(rows)};
        const I16 bendAlong = loadBlocks(curves.data());
        alignas(16) const std::array<int32_t, 4> thirds{isThird(columns), isThird(rows), isThird(columns),
                                                        isThird(rows)};
        const I16 along = loadBlocks(thirds.data());
        predict<false>(residuals, bendAlong, turned<1, 0, 1, 0>(bendAlong), along, turned<1, 0, 1, 0>(along));
    }

    // Vacant places repeat others.
    void storePatch(std::array<PatchAxis<int32_t>, 3>& to, unsigned columns, unsigned rows) const;
    void storeLanes(std::array<PatchAxis<int32_t>, 3>& to) const;

  private:
    // `along` and `across`: all bits set in lanes whose line has three steps.
    template <bool whole>
    HWY_INLINE void predict(const PatchResiduals& r, const I16& bendAlong, const I16& bendAcross,
                            const I16& along, const I16& across) {
        // Ends of the edges, from the left or the top.
        const Four from = turned<0, 1, 3, 0>(corners), to = turned<1, 2, 2, 3>(corners);
        const auto mid = [](const Four& p, const Four& q, const I16& thirds)
                             HWY_ATTR { return whole ? halfOf(p, q) : midOf(p, q, thirds); };
        const Four guessed = mid(from, to, along);
        mids = wrappedFour(guessed + r[PatchFour::edgeMids]);
        const Four bend = bent(mids, from, to, bendAlong);
        low = wrappedFour(halfOf(from, mids) + bend + r[lowQuarters]);
        high = wrappedFour(halfOf(mids, to) + bend + r[highQuarters]);
        // Lane 0 from the top down, lane 3 from left to right.
        const Four between = mid(mids, turned<2, 3, 0, 1>(mids), across);
        const Four guess = mid(guessed, turned<2, 3, 0, 1>(guessed), across);
        const Four sum = turned<0, 0, 0, 0>(between) + turned<3, 3, 3, 3>(between);
        centre = wrappedFour(sum - turned<0, 0, 0, 0>(guess) + r[middle]);
        const Four turn = bent(centre, mids, turned<2, 3, 0, 1>(mids), bendAcross);
        crosses = wrappedFour(halfOf(centre, mids) + turn + r[PatchFour::crosses]);
        setDiagonals(r[PatchFour::diagonals]);
    }

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
HWY_INLINE Four tileCorners(const uint8_t* record, const ResidualReader& reader) {
    static constexpr FourLanes order{{0, 1, 2, 2}};
    static constexpr FourLanes third{{0, 0, -1, 0}};
    const VertexFields fields = reader.fieldsAt(0);
    // Right, below, last.
    const Four r = reader.readPlain(fields, order.all() * all(static_cast<int32_t>(fields.bits)));
    const Four last = turned<1, 1, 1, 1>(r) + turned<2, 2, 2, 2>(r);
    const Four base = spread(loadBlocks(reinterpret_cast<const int32_t*>(record + 8)));
    return wrappedFour(base + (turned<0, 0, 0, 1>(r) & behindFirst.all()) + (last & third.all()));
}

// What the record says of the boxes of blocks, by their places.
struct BlockReaches {
    I16 low, high;
};
HWY_INLINE BlockReaches reachesOf(const uint8_t* record, uint32_t blocks, unsigned columns, unsigned rows) {
    I16 bytes;
    if (blocks == 0xffff) {
        bytes = loadBytes(record + tileHeaderBytes);
    } else {
        alignas(16) std::array<uint8_t, 16> placed{};
        for (unsigned k = 0; k < 16; ++k) {
            if ((blocks >> k & 1) != 0)
                placed[k] = record[tileHeaderBytes + stepsAtPlaces[rows][k / 4] * columns +
                                   stepsAtPlaces[columns][k % 4]];
        }
        bytes = loadBytes(placed.data());
    }
    return {shiftRight<2>(bytes) & all(7), shiftRight<5>(bytes)};
}

// Widens the boxes of the blocks' corners by what the record says.
inline void setBoxes(const uint8_t* record, const BlockReaches& reaches, TileBlocks& tile) {
    const I16 both = greatest(reaches.low, reaches.high);
    const unsigned dominant = fieldOf(loadLe<uint32_t>(record + 4), 26, 2);
    for (unsigned axis = 0; axis < 3; ++axis) {
        const I16 first = load(tile.points[axis].data()), second = load(tile.points[axis].data() + 16);
        const I16 a = pick(first, second, quadCorners.a.data()),
                  b = pick(first, second, quadCorners.b.data());
        const I16 c = pick(first, second, quadCorners.c.data()),
                  d = pick(first, second, quadCorners.d.data());
        const I16 unit = all(static_cast<int32_t>(reachUnit(record[11 + 4 * axis])));
        const bool isMain = axis == dominant;
        // Clamped, so that floats hold them exactly.
        const I16 least4 = least(least(a, b), least(c, d)) - unit * (isMain ? reaches.low : both);
        const I16 most4 = greatest(greatest(a, b), greatest(c, d)) + unit * (isMain ? reaches.high : both);
        store(toFloat(greatest(least4, all(0))), tile.low[axis].data());
        store(toFloat(least(most4, all(latticeLimit))), tile.high[axis].data());
    }
}

inline void decodeTileBlocks(const uint8_t* record, TileBlocks& tile) {
    const TilePlan plan(record);
    const unsigned columns = blocksOf(plan.columns), rows = blocksOf(plan.rows);
    const ResidualReader reader(record, plan, 0, 0, 4);
    const VertexFields fields = reader.fieldsAt(coarseField);
    const I16 first = all(static_cast<int32_t>(plan.coarse)), bits = all(static_cast<int32_t>(fields.bits));
    PatchResiduals residuals;
    for (unsigned four = 0; four < patchFours; ++four)
        residuals[four] = reader.read(
            four, fields, first + bits * loadBlocks(coarseFieldLanes[columns][rows][four].data()));
    const Four corners = tileCorners(record, reader);
    if (columns == 4 && rows == 4) {
        PatchFours(corners, residuals, 0).storePatch(tile.points, 4, 4);
    } else {
        PatchFours(corners, residuals, columns, rows, 0).storePatch(tile.points, columns, rows);
    }
    tile.blocks = stepMask(columns, rows);
    setBoxes(record, reachesOf(record, tile.blocks, columns, rows), tile);
}

// The corners of a block, clockwise; `first` is where the first stands.
HWY_INLINE Four blockCorners(const TileBlocks& tile, unsigned first) {
    struct Table {
        alignas(64) std::array<int32_t, 16> bytes;
    };
    static constexpr Table table{{0, 4, 24, 20, 128, 132, 152, 148, 256, 260, 280, 276, 0, 0, 0, 0}};
    return gather(reinterpret_cast<const uint8_t*>(tile.points[0].data() + first), load(table.bytes.data()));
}

// Where the fours of a block begin.
using PlaceLanes = std::array<I16, patchFours>;

// Of block `block` where all 16 are whole.
HWY_INLINE void setWholePlaces(const TilePlan& plan, unsigned block,
                               const std::array<VertexFields, residualClasses>& fields, PlaceLanes& places) {
    const auto number = [](unsigned value) HWY_ATTR { return all(static_cast<int32_t>(value)); };
    const I16 mids = loadBlocks(wholeEdges.mids[block].data());
    const I16 quarter = number(fields[edgeQuarter].bits);
    places[edgeMids] = number(plan.edgeMids) + mids * number(fields[edgeMid].bits);
    places[lowQuarters] = number(plan.edgeQuarters) + (mids + mids) * quarter;
    places[highQuarters] = places[lowQuarters] + quarter;
    const uint32_t inside = plan.insideOf(block);
    const uint32_t behindCentre = inside + fields[insideCentre].bits;
    places[middle] = number(inside);
    places[crosses] = number(behindCentre) +
                      loadBlocks(insideFieldLanes[crosses].data()) * number(fields[insideCross].bits);
    places[diagonals] = number(behindCentre + 4 * fields[insideCross].bits) +
                        loadBlocks(insideFieldLanes[diagonals].data()) * number(fields[insideDiagonal].bits);
}
// Of any block.
inline void setAnyPlaces(const TilePlan& plan, unsigned i, unsigned j, unsigned drop, PlaceLanes& places) {
    FieldPlaces found;
    setEdgePlaces(plan, i, j, found);
    setInsidePlaces(plan, j * blocksOf(plan.columns) + i, stepsOfBlock(plan.columns, i),
                    stepsOfBlock(plan.rows, j), drop, found);
    for (unsigned four = 0; four < patchFours; ++four)
        places[four] = loadBlocks(reinterpret_cast<const int32_t*>(found[four].data()));
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
    const TilePlan plan(record);
    const unsigned i = stepsAtPlaces[blocksOf(plan.columns)][place % 4];
    const unsigned j = stepsAtPlaces[blocksOf(plan.rows)][place / 4];
    const unsigned columns = stepsOfBlock(plan.columns, i), rows = stepsOfBlock(plan.rows, j);
    const unsigned number = j * blocksOf(plan.columns) + i;
    const unsigned drop = dropOf(record[tileHeaderBytes + number]);
    const ResidualReader reader(record, plan, static_cast<int32_t>(4 * i), static_cast<int32_t>(4 * j), 1);
    const std::array<VertexFields, residualClasses> fields{
        reader.fieldsOf(edgeMid, 0), reader.fieldsOf(edgeQuarter, 0), reader.fieldsOf(insideCentre, drop),
        reader.fieldsOf(insideCross, drop), reader.fieldsOf(insideDiagonal, drop)};
    PlaceLanes places;
    if (plan.isWhole()) {
        setWholePlaces(plan, number, fields, places);
    } else {
        setAnyPlaces(plan, i, j, drop, places);
    }
    PatchResiduals residuals;
    for (unsigned four = 0; four < patchFours; ++four)
        residuals[four] = reader.read(four, fields[classOfFour[four]], places[four]);
    const Four corners = blockCorners(tile, place / 4 * 5 + place % 4);
    const unsigned curve = fieldOf(loadLe<uint32_t>(record + 4), 28, 3);
    const PatchFours fours = columns == 4 && rows == 4 ? PatchFours(corners, residuals, curve)
                                                       : PatchFours(corners, residuals, columns, rows, curve);
    alignas(64) std::array<PatchAxis<int32_t>, 3> points;
    fours.storePatch(points, columns, rows);
    for (size_t k = 0; k < 3; ++k) {
        store(toFloat(load(points[k].data())), block.points[k].data());
        store(toFloat(load(points[k].data() + 16)), block.points[k].data() + 16);
    }
    block.quads = stepMask(columns, rows);
    block.bd = plan.diagonals == TileDiagonals::allBd ? 0xffff : 0;
    if (plan.diagonals == TileDiagonals::mixed) block.bd = diagonalsOf(record, number, block, columns, rows);
}

}  // namespace filigree::grid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
