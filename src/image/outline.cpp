#include "filigree/image/outline.h"

#include "image/threshold_bits.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

namespace filigree::image {
namespace {

// A point of the outline in a cell.
struct Point {
    double x = 0;
    double y = 0;
};

// The curve patch == 0 between two points of a cell. It is one branch of a hyperbola (or a line): convex, and
// monotone in x and in y, so it stays inside the rectangle that its ends span.
struct Arc {
    Point from;
    Point to;
};

constexpr double splitBulge = 1.0 / 64;  // an arc is split until it bulges less, texels
constexpr int mostSplits = 4;            // halvings of one arc

bool isBetween(double v, double a, double b) {
    return v >= std::min(a, b) && v <= std::max(a, b);
}

// The furthest point of an arc from its chord: where the tangent is parallel to it. On y = A + B / (x - s)
// that is the geometric mean of the ends' distances to s. None where rounding could move it far, next to a
// saddle at the threshold.
std::optional<Point> middleOf(const Patch& patch, const Arc& arc) {
    const bool alongX = std::fabs(arc.to.x - arc.from.x) >= std::fabs(arc.to.y - arc.from.y);
    const double from = alongX ? arc.from.x : arc.from.y;
    const double to = alongX ? arc.to.x : arc.to.y;
    const double across = alongX ? patch.alongY : patch.alongX;
    const double along = alongX ? patch.alongX : patch.alongY;
    double at = (from + to) / 2;
    if (patch.twist != 0) {
        const double pole = -across / patch.twist;
        const double product = (from - pole) * (to - pole);
        if (!(product > 0)) return std::nullopt;
        at = pole + (from < pole ? -1 : 1) * std::sqrt(product);
        at = std::clamp(at, std::min(from, to), std::max(from, to));
    }
    const double denominator = across + patch.twist * at;
    if (std::fabs(denominator) <= 1e-9 * (std::fabs(across) + std::fabs(patch.twist))) return std::nullopt;
    const double other = (patch.threshold - patch.corner - along * at) / denominator;
    const Point middle = alongX ? Point{at, other} : Point{other, at};
    const bool inside =
        isBetween(middle.x, arc.from.x, arc.to.x) && isBetween(middle.y, arc.from.y, arc.to.y);
    return inside ? std::optional(middle) : std::nullopt;
}

double distanceToChord(const Arc& arc, const Point& p) {
    const double dx = arc.to.x - arc.from.x;
    const double dy = arc.to.y - arc.from.y;
    const double length = std::hypot(dx, dy);
    if (length == 0) return std::hypot(p.x - arc.from.x, p.y - arc.from.y);
    return std::fabs(dx * (p.y - arc.from.y) - dy * (p.x - arc.from.x)) / length;
}

OutlinePiece pieceOf(const Arc& arc, int32_t cell, int32_t row, double bulge) {
    return {cell,
            row,
            static_cast<float>(arc.from.x),
            static_cast<float>(arc.from.y),
            static_cast<float>(arc.to.x),
            static_cast<float>(arc.to.y),
            static_cast<float>(bulge * 1.000001)};
}

// Where the pieces of one cell go.
struct PieceSink {
    Outline::PieceArrays& arrays;
    int32_t cell;
    int32_t row;

    void push(const Arc& arc, double bulge) const {
        const OutlinePiece piece = pieceOf(arc, cell, row, bulge);
        arrays.cell.push_back(cell);
        arrays.row.push_back(row);
        arrays.x0.push_back(piece.x0);
        arrays.y0.push_back(piece.y0);
        arrays.x1.push_back(piece.x1);
        arrays.y1.push_back(piece.y1);
        arrays.bulge.push_back(piece.bulge);
    }
};

// How far an arc may stray from its chord. Whatever it does, it stays in the rectangle of its ends.
double bulgeOf(const Arc& arc, const std::optional<Point>& middle) {
    const double most = distanceToChord(arc, {arc.from.x, arc.to.y});
    return middle ? std::min(most, distanceToChord(arc, *middle) * 1.001 + 1e-6) : most;
}

// Appends an arc as pieces, split until they are nearly straight.
void appendArc(const Patch& patch, const Arc& arc, int splits, const PieceSink& sink) {
    double bulge = 0;
    if (patch.twist != 0) {
        const std::optional<Point> middle = middleOf(patch, arc);
        bulge = bulgeOf(arc, middle);
        if (middle && bulge > splitBulge && splits < mostSplits) {
            appendArc(patch, {arc.from, *middle}, splits + 1, sink);
            appendArc(patch, {*middle, arc.to}, splits + 1, sink);
            return;
        }
    }
    sink.push(arc, bulge);
}

// Corners of a cell in turn: 00, 10, 11, 01. Edge k runs from corner k to corner k + 1.
constexpr std::array<Point, 4> cornerAt{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

// Where the outline meets edge k, whose ends take `a` and `b` of opposite sides.
Point crossing(unsigned k, double a, double b) {
    const double t = std::clamp(a / (a - b), 0.0, 1.0);
    const Point p = cornerAt[k];
    const Point q = cornerAt[(k + 1) % 4];
    return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
}

// The arcs of a bilinear cell with corner values `v` (minus the threshold; opaque where >= 0), in turn.
void appendBilinear(const Patch& patch, const std::array<double, 4>& v, const PieceSink& sink) {
    std::array<Point, 4> met{};
    unsigned count = 0;
    for (unsigned k = 0; k < 4; ++k) {
        if ((v[k] >= 0) == (v[(k + 1) % 4] >= 0)) continue;
        met[count++] = crossing(k, v[k], v[(k + 1) % 4]);
    }
    if (count == 2) {
        appendArc(patch, {met[0], met[1]}, 0, sink);
    } else if (count == 4) {
        // A saddle: two arcs. Where the saddle's value joins the corners of corner 0's side, they cut off the
        // others.
        const double saddle = patch.corner - patch.threshold - patch.alongX * patch.alongY / patch.twist;
        const bool joinsCorner0 = (saddle >= 0) == (v[0] >= 0);
        const unsigned first = joinsCorner0 ? 0 : 3;
        appendArc(patch, {met[first], met[(first + 1) % 4]}, 0, sink);
        appendArc(patch, {met[(first + 2) % 4], met[(first + 3) % 4]}, 0, sink);
    }
}

// Nearest filtering: texel squares meet at the cell's middle, along half lines between texels of unlike side.
void appendNearest(const std::array<bool, 4>& opaque, const PieceSink& sink) {
    for (unsigned k = 0; k < 4; ++k) {
        if (opaque[k] == opaque[(k + 1) % 4]) continue;
        const Point& p = cornerAt[k];
        const Point& q = cornerAt[(k + 1) % 4];
        sink.push({{(p.x + q.x) / 2, (p.y + q.y) / 2}, {0.5, 0.5}}, 0);
    }
}

// The lowest texel value t in 0..65536, a multiple of 65535 / steps, for which passes(a, steps) holds.
template <class Passes>
uint32_t lowestPassing(uint32_t steps, Passes&& passes) {
    uint32_t low = 0;
    uint32_t high = steps + 1;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (passes(middle)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low > steps ? 65536 : low * (65535 / steps);
}

Threshold thresholdFor(uint32_t lowestOpaque, double exact, uint32_t steps) {
    const double step = 65535.0 / steps;
    const double highest = lowestOpaque;
    const double lowest = highest - step;
    if (lowestOpaque == 0) return {0, -1};
    if (exact > lowest && exact <= highest) return {lowestOpaque, exact};
    return {lowestOpaque, highest};
}

}  // namespace

std::vector<Threshold> thresholdsOf(const AlphaTest& test, double vertexAlpha, uint32_t steps) {
    const double factor = test.factor * vertexAlpha;
    const float floatFactor = static_cast<float>(test.factor) * static_cast<float>(vertexAlpha);
    if (test.mode == AlphaMode::blend) {
        AlphaTest one = test;
        one.mode = AlphaMode::mask;
        one.cutoff = 1;
        std::vector<Threshold> thresholds = thresholdsOf(one, vertexAlpha, steps);
        thresholds.push_back(factor > 0 ? Threshold{65535 / steps, std::numeric_limits<double>::min()}
                                        : Threshold{65536, 65536});
        return thresholds;
    }
    const double exact = factor > 0 ? test.cutoff * 65535 / factor : std::numeric_limits<double>::infinity();
    const uint32_t inDouble =
        lowestPassing(steps, [&](uint32_t a) { return a / double(steps) * factor >= test.cutoff; });
    const uint32_t inFloat = lowestPassing(steps, [&](uint32_t a) {
        return static_cast<float>(a) / static_cast<float>(steps) * floatFactor >=
               static_cast<float>(test.cutoff);
    });
    std::vector<Threshold> thresholds{thresholdFor(inDouble, exact, steps)};
    if (inFloat != inDouble) thresholds.push_back(thresholdFor(inFloat, exact, steps));
    return thresholds;
}

Threshold sideThreshold(const AlphaTest& test, double vertexAlpha, uint32_t steps) {
    AlphaTest mask = test;
    if (test.mode == AlphaMode::blend) mask.cutoff = 0.5;
    mask.mode = AlphaMode::mask;
    return thresholdsOf(mask, vertexAlpha, steps).front();
}

CellAxis::CellAxis(uint32_t texels, Wrap mode)
    : size(texels),
      wrap(mode),
      cells(mode == Wrap::repeat           ? texels
            : mode == Wrap::mirroredRepeat ? 2 * int64_t{texels}
                                           : int64_t{texels} + 1) {}

Outline::Outline(const AlphaTexture& texture, Filter filter, const Threshold& threshold)
    : texture_(&texture),
      filter_(filter),
      threshold_(threshold),
      axisX_(texture.image.width, texture.wrapU),
      axisY_(texture.image.height, texture.wrapV) {
    assert(filter != Filter::both);
    build();
}

void Outline::build() {
    rowBuckets_ = static_cast<size_t>((axisX_.cells + bucketCells - 1) / bucketCells);
    columns_.resize(static_cast<size_t>(axisX_.cells) + 1);
    for (int64_t x = 0; x <= axisX_.cells; ++x) {
        columns_[static_cast<size_t>(x)] = wrapTexel(axisX_.representative(x), axisX_.size, axisX_.wrap);
    }
    for (int64_t y = 0; y < axisY_.cells; y += bandRows) buildBand(y);
    const size_t count = pieces_.cell.size();
    bucketStart_.push_back(static_cast<uint32_t>(count));
    const auto pad = [&](auto&... field) { (field.resize(count + padding), ...); };
    pad(pieces_.cell, pieces_.row, pieces_.x0, pieces_.y0, pieces_.x1, pieces_.y1, pieces_.bulge);
}

const uint16_t* Outline::texelRow(int64_t row) const {
    return &texture_->image.texels[size_t{wrapTexel(row, axisY_.size, axisY_.wrap)} * axisX_.size];
}

std::vector<uint64_t> Outline::opaqueBits(int64_t row) const {
    const uint16_t* texels = texelRow(row);
    std::vector<uint64_t> bits(columns_.size() / 64 + 2, 0);
    const size_t size = axisX_.size;
    if (axisX_.wrap == Wrap::repeat) {
        thresholdBits(texels, size, threshold_.lowestOpaque, bits.data());
        bits[size / 64] |= uint64_t{texels[0] >= threshold_.lowestOpaque} << (size % 64);
    } else {
        std::vector<uint16_t> inOrder(columns_.size());
        std::ranges::transform(columns_, inOrder.begin(), [&](uint32_t column) { return texels[column]; });
        thresholdBits(inOrder.data(), inOrder.size(), threshold_.lowestOpaque, bits.data());
    }
    return bits;
}

std::vector<uint64_t> Outline::crossedBits(const std::vector<uint64_t>& low,
                                           const std::vector<uint64_t>& high) const {
    std::vector<uint64_t> crossed(low.size() - 1);
    for (size_t w = 0; w < crossed.size(); ++w) {
        const uint64_t lowRight = (low[w] >> 1) | (low[w + 1] << 63);
        const uint64_t highRight = (high[w] >> 1) | (high[w + 1] << 63);
        crossed[w] = (low[w] | lowRight | high[w] | highRight) & ~(low[w] & lowRight & high[w] & highRight);
    }
    const auto cells = static_cast<size_t>(axisX_.cells);
    crossed[cells / 64] &= (uint64_t{1} << (cells % 64)) - 1;
    return crossed;
}

void Outline::buildBand(int64_t firstRow) {
    const int64_t rows = std::min(bandRows, axisY_.cells - firstRow);
    std::array<std::vector<uint64_t>, bandRows> crossed;
    std::vector<uint64_t> low = opaqueBits(axisY_.representative(firstRow));
    for (int64_t r = 0; r < rows; ++r) {
        std::vector<uint64_t> high = opaqueBits(axisY_.representative(firstRow + r) + 1);
        crossed[static_cast<size_t>(r)] = crossedBits(low, high);
        low = std::move(high);
    }
    for (size_t bucket = 0; bucket < rowBuckets_; ++bucket) {
        bucketStart_.push_back(static_cast<uint32_t>(pieces_.cell.size()));
        const size_t first = bucket * bucketCells;
        for (int64_t r = 0; r < rows; ++r) {
            uint64_t bits = (crossed[static_cast<size_t>(r)][first / 64] >> (first % 64)) & 0xff;
            for (; bits != 0; bits &= bits - 1) {
                appendCell(first + static_cast<size_t>(std::countr_zero(bits)), firstRow + r);
            }
        }
    }
}

void Outline::appendCell(size_t column, int64_t row) {
    const uint16_t* low = texelRow(axisY_.representative(row));
    const uint16_t* high = texelRow(axisY_.representative(row) + 1);
    const uint32_t left = columns_[column];
    const uint32_t right = columns_[column + 1];
    const std::array<uint16_t, 4> t{low[left], low[right], high[right], high[left]};
    const PieceSink sink{pieces_, static_cast<int32_t>(column), static_cast<int32_t>(row)};
    if (filter_ == Filter::nearest) {
        std::array<bool, 4> opaque{};
        for (size_t k = 0; k < 4; ++k) opaque[k] = t[k] >= threshold_.lowestOpaque;
        appendNearest(opaque, sink);
    } else {
        const double value = threshold_.value;
        appendBilinear(Patch::of(t[0], t[1], t[3], t[2], value),
                       {t[0] - value, t[1] - value, t[2] - value, t[3] - value}, sink);
    }
}

std::optional<std::array<OutlinePiece, 2>> Outline::split(const OutlinePiece& piece,
                                                          const Patch& patch) const {
    const Arc arc{{piece.x0, piece.y0}, {piece.x1, piece.y1}};
    Point middle{(arc.from.x + arc.to.x) / 2, (arc.from.y + arc.to.y) / 2};
    if (filter_ == Filter::linear && patch.twist != 0) {
        const std::optional<Point> onArc = middleOf(patch, arc);
        if (!onArc) return std::nullopt;
        middle = *onArc;
    }
    const auto half = [&](const Arc& part) {
        const bool bent = filter_ == Filter::linear && patch.twist != 0;
        return pieceOf(part, piece.cell, piece.row, bent ? bulgeOf(part, middleOf(patch, part)) : 0);
    };
    return std::array{half({arc.from, middle}), half({middle, arc.to})};
}

Outline::Side Outline::sideAt(double x, double y) const {
    if (filter_ == Filter::nearest) {
        const auto column = static_cast<int64_t>(std::floor(x + 0.5));
        return {texelIsOpaque(column, static_cast<int64_t>(std::floor(y + 0.5))), 1};
    }
    const double left = std::floor(x);
    const double low = std::floor(y);
    const auto cellX = static_cast<int64_t>(left);
    const auto cellY = static_cast<int64_t>(low);
    const auto column = static_cast<size_t>(axisX_.canonical(cellX));
    const uint16_t* lowRow = texelRow(cellY);
    const uint16_t* highRow = texelRow(cellY + 1);
    const std::array<uint16_t, 4> t{lowRow[columns_[column]], lowRow[columns_[column + 1]],
                                    highRow[columns_[column]], highRow[columns_[column + 1]]};
    const auto isOpaque = [&](uint16_t texel) { return texel >= threshold_.lowestOpaque; };
    const bool opaque = isOpaque(t[0]);
    if (isOpaque(t[1]) == opaque && isOpaque(t[2]) == opaque && isOpaque(t[3]) == opaque) return {opaque, 1};
    const double value =
        Patch::of(t[0], t[1], t[2], t[3], threshold_.value).at(PatchPoint<double>{x - left, y - low});
    return {value >= 0, std::fabs(value) / 65535};
}

size_t Outline::memoryBytes() const {
    return (columns_.capacity() + bucketStart_.capacity()) * sizeof(uint32_t) +
           pieces_.cell.capacity() * sizeof(OutlinePiece);
}

}  // namespace filigree::image
