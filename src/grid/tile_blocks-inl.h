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

// x, y, z and 0, each in all lanes of its block.
HWY_INLINE I16 axisBlocks(int32_t x, int32_t y, int32_t z) {
    alignas(64) static constexpr std::array<int32_t, 16> isX{-1, -1, -1, -1};
    alignas(64) static constexpr std::array<int32_t, 16> isY{0, 0, 0, 0, -1, -1, -1, -1};
    alignas(64) static constexpr std::array<int32_t, 16> isZ{0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1};
    return (all(x) & load(isX.data())) | (all(y) & load(isY.data())) | (all(z) & load(isZ.data()));
}

// What the dominant axis' residuals add to the others.
struct Shear {
    bool isNone = true;
    I16 slope, perColumn, perRow;  // [block], 0 for the dominant axis

    HWY_INLINE explicit Shear(const TileHeader& head) {
        const auto minors = minorAxes(head.dominant);
        std::array<int32_t, 3> s{}, x{}, y{};
        for (unsigned m = 0; m < 2; ++m) {
            s[minors[m]] = 8 * head.shear[m];
            x[minors[m]] = head.shearColumn[m];
            y[minors[m]] = head.shearRow[m];
            isNone = isNone && (head.shear[m] | head.shearColumn[m] | head.shearRow[m]) == 0;
        }
        slope = axisBlocks(s[0], s[1], s[2]);
        perColumn = axisBlocks(x[0], x[1], x[2]);
        perRow = axisBlocks(y[0], y[1], y[2]);
    }
};

// Reads residuals of fours of vertices.
class ResidualReader {
  public:
    HWY_INLINE ResidualReader(const uint8_t* bits, const TileHeader& head)
        : bits_(bits), dominant_(head.dominant), shear_(head) {}

    // `x`, `y` say where the four stands in the tile's frame.
    HWY_INLINE Four read(const std::array<int32_t, 4>& places, const ClassFields& fields, const int32_t* x,
                         const int32_t* y) const {
        const auto& w = fields.width;
        const auto width = [&](unsigned k) { return static_cast<int32_t>(w[k]); };
        const auto bias = [&](unsigned k) {
            return biasOf(k == dominant_ ? fields.dominantBias : evenBias, w[k]);
        };
        const I16 at = loadBlocks(places.data()) + axisBlocks(0, width(0), width(0) + width(1));
        const I16 words = shiftRightBy(gather(bits_, shiftRight<3>(at)), at & all(7));
        const I16 one = all(1);
        const I16 mask = shiftLeftBy(one, axisBlocks(width(0), width(1), width(2))) - one;
        const Four residual = (words & mask) - axisBlocks(bias(0), bias(1), bias(2));
        if (shear_.isNone) return residual;
        alignas(64) std::array<int32_t, 16> kept;
        store(residual, kept.data());
        const I16 main = loadBlocks(kept.data() + size_t{4} * dominant_);
        const I16 slope = shear_.slope + shear_.perColumn * (loadBlocks(x)) + shear_.perRow * loadBlocks(y);
        return residual + shiftRight<8>(slope * main + all(128));
    }

  private:
    const uint8_t* bits_;
    unsigned dominant_;
    Shear shear_;
};

struct PatchFields {
    FieldPlaces places;
    std::array<ClassFields, patchFours> fields;
    // Of the frame, less 8, and how far a place is.
    int32_t x = 0;
    int32_t y = 0;
    int32_t stride = 1;
};

struct PatchResiduals {
    std::array<Four, patchFours> four;

    HWY_INLINE PatchResiduals(const ResidualReader& reader, const PatchFields& patch) {
        for (unsigned k = 0; k < patchFours; ++k) {
            alignas(16) std::array<int32_t, 4> x, y;
            for (unsigned lane = 0; lane < 4; ++lane) {
                x[lane] = patch.x + patch.stride * placesOfFour[k][lane].x;
                y[lane] = patch.y + patch.stride * placesOfFour[k][lane].y;
            }
            four[k] = reader.read(patch.places[k], patch.fields[k], x.data(), y.data());
        }
    }
};

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
        const auto& r = residuals.four;
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

inline void PatchFours::storePatch(std::array<PatchAxis<int32_t>, 3>& to, unsigned columns,
                                   unsigned rows) const {
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
        if (columns == 4 && rows == 4) continue;
        for (unsigned y = 0; y < 5; ++y)
            for (unsigned x = 0; x < 5; ++x)
                to[axis][5 * y + x] = to[axis][5U * vertexAtPlace[rows][y] + vertexAtPlace[columns][x]];
    }
}

HWY_INLINE ClassFields fieldsOf(const TileHeader& head, ResidualClass c, unsigned drop) {
    const FieldWidths of = fineFields(head, c, drop);
    return {of.width, of.dominantBias};
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
    const TileParts parts = tileParts(head);
    const uint8_t* bits = record + parts.bits;
    const unsigned columns = head.blockColumns(), rows = head.blockRows();
    const ClassFields fields{head.coarseWidth, evenBias};
    PatchFields patch{{}, {}, -8, -8, 4};
    patch.fields.fill(fields);
    for (unsigned four = 0; four < patchFours; ++four)
        for (unsigned k = 0; k < 4; ++k)
            patch.places[four][k] =
                static_cast<int32_t>(parts.coarse + fields.bits() * coarseFields[columns][rows][four][k]);
    const ResidualReader reader(bits, head);
    const PatchFours fours(tileCorners(head, bits), PatchResiduals(reader, patch), columns, rows, 0);
    fours.storePatch(tile.points, columns, rows);
    tile.blocks = stepMask(columns, rows);
    setBoxes(record, head, tile);
}

// `place`: bit of TileBlocks::blocks.
inline void decodeTileBlock(const uint8_t* record, const TileBlocks& tile, unsigned place, Block& block) {
    const TileHeader head = loadTileHeader(record);
    const TileParts parts = tileParts(head);
    const uint8_t* bits = record + parts.bits;
    const unsigned i = stepsAtPlaces[head.blockColumns()][place % 4];
    const unsigned j = stepsAtPlaces[head.blockRows()][place / 4];
    const unsigned columns = head.columnsOf(i), rows = head.rowsOf(j);
    const unsigned number = j * head.blockColumns() + i;
    const unsigned drop = dropOf(record[tileHeaderBytes + number]);
    PatchFields patch{{}, {}, static_cast<int32_t>(4 * i) - 8, static_cast<int32_t>(4 * j) - 8, 1};
    for (unsigned four = 0; four < patchFours; ++four)
        patch.fields[four] = fieldsOf(head, classOfFour[four], four < crosses ? 0 : drop);
    setEdgePlaces(head, parts, i, j, patch.places);
    uint32_t at = insidePlace(record, head, parts, i, j);
    const InsideCounts counts = insideCounts(columns, rows);
    for (const unsigned four : {unsigned{middle}, unsigned{crosses}, unsigned{diagonals}}) {
        const unsigned vertex = patch.fields[four].bits();
        for (unsigned k = 0; k < 4; ++k)
            patch.places[four][k] = static_cast<int32_t>(at + vertex * insideFields[columns][rows][four][k]);
        at += vertex * (four == middle ? counts.centres : counts.crosses);
    }
    alignas(64) std::array<int32_t, 16> corners{};
    const unsigned first = place / 4 * 5 + place % 4;
    for (unsigned k = 0; k < 3; ++k) {
        corners[4 * k] = tile.points[k][first];
        corners[4 * k + 1] = tile.points[k][first + 1];
        corners[4 * k + 2] = tile.points[k][first + 6];
        corners[4 * k + 3] = tile.points[k][first + 5];
    }
    const ResidualReader reader(bits, head);
    const PatchFours fours(load(corners.data()), PatchResiduals(reader, patch), columns, rows, head.curve);
    alignas(64) std::array<PatchAxis<int32_t>, 3> points;
    fours.storePatch(points, columns, rows);
    for (size_t k = 0; k < 3; ++k) {
        store(toFloat(load(points[k].data())), block.points[k].data());
        store(toFloat(load(points[k].data() + 16)), block.points[k].data() + 16);
    }
    block.quads = stepMask(columns, rows);
    block.bd = head.diagonals == TileDiagonals::allBd ? 0xffff : 0;
    if (head.diagonals == TileDiagonals::mixed) {
        const uint32_t stored = loadLe<uint16_t>(record + parts.diagonals + size_t{2} * number);
        for (unsigned k = 0; k < 16; ++k) {
            if ((block.quads >> k & 1) == 0) continue;
            const unsigned x = stepsAtPlaces[columns][k % 4], y = stepsAtPlaces[rows][k / 4];
            block.bd |= (stored >> (4 * y + x) & 1) << k;
        }
    }
}

}  // namespace filigree::grid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
