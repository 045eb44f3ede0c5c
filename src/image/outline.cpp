#include "filigree/image/outline.h"

#include "image/arcs.h"
#include "image/threshold_bits.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

namespace filigree::image {
namespace {

OutlinePiece pieceOf(const ArcPiece& piece, int32_t cell, int32_t row) {
    return {cell,
            row,
            static_cast<float>(piece.arc.from.x),
            static_cast<float>(piece.arc.from.y),
            static_cast<float>(piece.arc.to.x),
            static_cast<float>(piece.arc.to.y),
            static_cast<float>(piece.bulge * 1.000001)};
}

void push(const OutlinePiece& piece, Outline::PieceArrays& to) {
    to.cell.push_back(piece.cell);
    to.row.push_back(piece.row);
    to.x0.push_back(piece.x0);
    to.y0.push_back(piece.y0);
    to.x1.push_back(piece.x1);
    to.y1.push_back(piece.y1);
    to.bulge.push_back(piece.bulge);
}

}  // namespace

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
    std::vector<ArcPiece> scratch;
    for (int64_t y = 0; y < axisY_.cells; y += bandRows) buildBand(y, scratch);
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

void Outline::buildBand(int64_t firstRow, std::vector<ArcPiece>& scratch) {
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
                appendCell(first + static_cast<size_t>(std::countr_zero(bits)), firstRow + r, scratch);
            }
        }
    }
}

void Outline::appendCell(size_t column, int64_t row, std::vector<ArcPiece>& scratch) {
    const uint16_t* low = texelRow(axisY_.representative(row));
    const uint16_t* high = texelRow(axisY_.representative(row) + 1);
    const uint32_t left = columns_[column];
    const uint32_t right = columns_[column + 1];
    const std::array<uint16_t, 4> t{low[left], low[right], high[right], high[left]};
    scratch.clear();
    if (filter_ == Filter::nearest) {
        std::array<bool, 4> opaque{};
        for (size_t k = 0; k < 4; ++k) opaque[k] = t[k] >= threshold_.lowestOpaque;
        appendNearest(opaque, scratch);
    } else {
        const double value = threshold_.value;
        appendBilinear(Patch::of(t[0], t[1], t[3], t[2], value),
                       {t[0] - value, t[1] - value, t[2] - value, t[3] - value}, scratch);
    }
    for (const ArcPiece& piece : scratch) {
        push(pieceOf(piece, static_cast<int32_t>(column), static_cast<int32_t>(row)), pieces_);
    }
}

std::optional<std::array<OutlinePiece, 2>> Outline::split(const OutlinePiece& piece,
                                                          const Patch& patch) const {
    const Arc arc{{piece.x0, piece.y0}, {piece.x1, piece.y1}};
    ArcPoint middle{(arc.from.x + arc.to.x) / 2, (arc.from.y + arc.to.y) / 2};
    if (filter_ == Filter::linear && patch.twist != 0) {
        const std::optional<ArcPoint> onArc = middleOf(patch, arc);
        if (!onArc) return std::nullopt;
        middle = *onArc;
    }
    const auto half = [&](const Arc& part) {
        const bool bent = filter_ == Filter::linear && patch.twist != 0;
        return pieceOf({part, bent ? bulgeOf(part, middleOf(patch, part)) : 0}, piece.cell, piece.row);
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
