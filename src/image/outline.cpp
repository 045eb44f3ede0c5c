#include "filigree/image/outline.h"

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
    const double other = -(patch.constant + along * at) / denominator;
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

OutlinePiece pieceOf(const Arc& arc, int32_t cell, double bulge) {
    return {cell,
            static_cast<float>(arc.from.x),
            static_cast<float>(arc.from.y),
            static_cast<float>(arc.to.x),
            static_cast<float>(arc.to.y),
            static_cast<float>(bulge * 1.000001)};
}

// How far an arc may stray from its chord. Whatever it does, it stays in the rectangle of its ends.
double bulgeOf(const Arc& arc, const std::optional<Point>& middle) {
    const double most = distanceToChord(arc, {arc.from.x, arc.to.y});
    return middle ? std::min(most, distanceToChord(arc, *middle) * 1.001 + 1e-6) : most;
}

// Appends an arc as pieces, split until they are nearly straight.
void appendArc(const Patch& patch, const Arc& arc, int32_t cell, int splits,
               std::vector<OutlinePiece>& pieces) {
    double bulge = 0;
    if (patch.twist != 0) {
        const std::optional<Point> middle = middleOf(patch, arc);
        bulge = bulgeOf(arc, middle);
        if (middle && bulge > splitBulge && splits < mostSplits) {
            appendArc(patch, {arc.from, *middle}, cell, splits + 1, pieces);
            appendArc(patch, {*middle, arc.to}, cell, splits + 1, pieces);
            return;
        }
    }
    pieces.push_back(pieceOf(arc, cell, bulge));
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
void appendBilinear(const Patch& patch, const std::array<double, 4>& v, int32_t cell,
                    std::vector<OutlinePiece>& pieces) {
    std::array<Point, 4> met{};
    unsigned count = 0;
    for (unsigned k = 0; k < 4; ++k) {
        if ((v[k] >= 0) == (v[(k + 1) % 4] >= 0)) continue;
        met[count++] = crossing(k, v[k], v[(k + 1) % 4]);
    }
    if (count == 2) {
        appendArc(patch, {met[0], met[1]}, cell, 0, pieces);
    } else if (count == 4) {
        // A saddle: two arcs. Where the saddle's value joins the corners of corner 0's side, they cut off the
        // others.
        const double saddle = patch.constant - patch.alongX * patch.alongY / patch.twist;
        const bool joinsCorner0 = (saddle >= 0) == (v[0] >= 0);
        const unsigned first = joinsCorner0 ? 0 : 3;
        appendArc(patch, {met[first], met[(first + 1) % 4]}, cell, 0, pieces);
        appendArc(patch, {met[(first + 2) % 4], met[(first + 3) % 4]}, cell, 0, pieces);
    }
}

// Nearest filtering: texel squares meet at the cell's middle, along half lines between texels of unlike side.
void appendNearest(const std::array<bool, 4>& opaque, int32_t cell, std::vector<OutlinePiece>& pieces) {
    for (unsigned k = 0; k < 4; ++k) {
        if (opaque[k] == opaque[(k + 1) % 4]) continue;
        const Point& p = cornerAt[k];
        const Point& q = cornerAt[(k + 1) % 4];
        pieces.push_back(
            {cell, static_cast<float>((p.x + q.x) / 2), static_cast<float>((p.y + q.y) / 2), 0.5f, 0.5f, 0});
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
        const Threshold zero = factor > 0 ? Threshold{65535 / steps, std::numeric_limits<double>::min()}
                                          : Threshold{65536, 65536};
        const Threshold one = factor >= 1 ? Threshold{65535, 65535} : Threshold{65536, 65536};
        return {one, zero};
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

Outline::Axis::Axis(uint32_t texels, Wrap mode)
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
    bucketStart_.reserve(static_cast<size_t>(axisY_.cells) * rowBuckets_ + 1);
    columns_.resize(static_cast<size_t>(axisX_.cells) + 1);
    for (int64_t x = 0; x <= axisX_.cells; ++x) {
        columns_[static_cast<size_t>(x)] = wrapTexel(axisX_.representative(x), axisX_.size, axisX_.wrap);
    }
    std::vector<uint64_t> low = opaqueBits(axisY_.representative(0));
    for (int64_t y = 0; y < axisY_.cells; ++y) {
        std::vector<uint64_t> high = opaqueBits(axisY_.representative(y) + 1);
        buildRow(y, low, high);
        low = std::move(high);
    }
    bucketStart_.push_back(static_cast<uint32_t>(pieces_.size()));
}

const uint16_t* Outline::texelRow(int64_t row) const {
    return &texture_->image.texels[size_t{wrapTexel(row, axisY_.size, axisY_.wrap)} * axisX_.size];
}

std::vector<uint64_t> Outline::opaqueBits(int64_t row) const {
    const uint16_t* texels = texelRow(row);
    std::vector<uint64_t> bits(columns_.size() / 64 + 2, 0);
    const uint32_t lowest = threshold_.lowestOpaque;
    for (size_t x = 0; x < columns_.size(); x += 64) {
        const size_t count = std::min<size_t>(64, columns_.size() - x);
        uint64_t word = 0;
        for (size_t k = 0; k < count; ++k) word |= uint64_t{texels[columns_[x + k]] >= lowest} << k;
        bits[x / 64] = word;
    }
    return bits;
}

void Outline::buildRow(int64_t y, const std::vector<uint64_t>& low, const std::vector<uint64_t>& high) {
    const int64_t row = axisY_.representative(y);
    const uint16_t* lowTexels = texelRow(row);
    const uint16_t* highTexels = texelRow(row + 1);
    for (size_t bucket = 0; bucket < rowBuckets_; ++bucket) {
        bucketStart_.push_back(static_cast<uint32_t>(pieces_.size()));
        const size_t first = bucket * bucketCells;
        const size_t end = std::min<size_t>(first + bucketCells, static_cast<size_t>(axisX_.cells));
        const uint64_t lowBits =
            (low[first / 64] >> (first % 64)) | (low[first / 64 + 1] << 1 << (63 - first % 64));
        const uint64_t highBits =
            (high[first / 64] >> (first % 64)) | (high[first / 64 + 1] << 1 << (63 - first % 64));
        const uint64_t any = lowBits | (lowBits >> 1) | highBits | (highBits >> 1);
        const uint64_t all = lowBits & (lowBits >> 1) & highBits & (highBits >> 1);
        uint64_t crossed = any & ~all & ((uint64_t{1} << (end - first)) - 1);
        for (; crossed != 0; crossed &= crossed - 1) {
            const size_t x = first + static_cast<size_t>(std::countr_zero(crossed));
            const uint32_t left = columns_[x];
            const uint32_t right = columns_[x + 1];
            appendPieces({lowTexels[left], lowTexels[right], highTexels[right], highTexels[left]},
                         static_cast<int32_t>(x));
        }
    }
}

void Outline::appendPieces(const std::array<uint16_t, 4>& t, int32_t cell) {
    if (filter_ == Filter::nearest) {
        std::array<bool, 4> opaque{};
        for (size_t k = 0; k < 4; ++k) opaque[k] = t[k] >= threshold_.lowestOpaque;
        appendNearest(opaque, cell, pieces_);
        return;
    }
    const std::array<double, 4> v{t[0] - threshold_.value, t[1] - threshold_.value, t[2] - threshold_.value,
                                  t[3] - threshold_.value};
    appendBilinear(Patch::of(t[0], t[1], t[3], t[2], threshold_.value), v, cell, pieces_);
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
        return pieceOf(part, piece.cell, bent ? bulgeOf(part, middleOf(patch, part)) : 0);
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
    const bool opaque = texelIsOpaque(cellX, cellY);
    const bool oneSide = texelIsOpaque(cellX + 1, cellY) == opaque &&
                         texelIsOpaque(cellX, cellY + 1) == opaque &&
                         texelIsOpaque(cellX + 1, cellY + 1) == opaque;
    if (oneSide) return {opaque, 1};
    const double value = patch(cellX, cellY).at(PatchPoint<double>{x - left, y - low});
    return {value >= 0, std::fabs(value) / 65535};
}

size_t Outline::memoryBytes() const {
    return (columns_.capacity() + bucketStart_.capacity()) * sizeof(uint32_t) +
           pieces_.capacity() * sizeof(OutlinePiece);
}

}  // namespace filigree::image
