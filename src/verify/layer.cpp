#include "verify/layer.h"

namespace filigree::verify {
namespace {

// `value` mod `period`, in [0, period).
int64_t floorMod(int64_t value, int64_t period) {
    const int64_t rest = value % period;
    return rest < 0 ? rest + period : rest;
}

uint32_t wrapped(int64_t at, uint32_t size, image::Wrap wrap) {
    const int64_t n = size;
    if (at >= 0 && at < n) return static_cast<uint32_t>(at);
    switch (wrap) {
        case image::Wrap::repeat:
            return static_cast<uint32_t>(floorMod(at, n));
        case image::Wrap::mirroredRepeat: {
            const int64_t place = floorMod(at, 2 * n);
            return static_cast<uint32_t>(place < n ? place : 2 * n - 1 - place);
        }
        default:
            return at < 0 ? 0 : size - 1;
    }
}

// In 16-bit lanes, for the vectoriser: long rows are most of the work on large micro-triangles.
TexelRange rangeOf(const uint16_t* texels, size_t count) {
    uint16_t lo = UINT16_MAX;
    uint16_t hi = 0;
    for (size_t k = 0; k < count; ++k) {
        lo = std::min(lo, texels[k]);
        hi = std::max(hi, texels[k]);
    }
    return {lo, hi};
}

}  // namespace

Layer::Layer(const image::AlphaImage& image, image::Wrap wrapU, image::Wrap wrapV)
    : image_(&image), wrapU_(wrapU), wrapV_(wrapV), rows_(image.height) {
    for (uint32_t y = 0; y < image.height; ++y) {
        rows_[y] = rangeOf(image.texels.data() + size_t{y} * image.width, image.width);
        whole_.add(rows_[y]);
    }
}

uint32_t Layer::texel(int64_t x, int64_t y) const {
    return image_->at(wrapped(x, width(), wrapU_), wrapped(y, height(), wrapV_));
}

CellTexels Layer::cell(int64_t x, int64_t y) const {
    const uint32_t left = wrapped(x, width(), wrapU_);
    const uint32_t right = wrapped(x + 1, width(), wrapU_);
    const uint32_t low = wrapped(y, height(), wrapV_);
    const uint32_t high = wrapped(y + 1, height(), wrapV_);
    return {image_->at(left, low), image_->at(right, low), image_->at(left, high), image_->at(right, high)};
}

Layer::Segments Layer::periodicSegments(int64_t first, int64_t last, uint32_t size, bool mirrored) {
    const int64_t n = size;
    const int64_t period = mirrored ? 2 * n : n;
    if (last - first + 1 >= period) return {{{{0, size - 1}}}, 1};
    Segments result;
    const int64_t begin = floorMod(first, period);
    const int64_t end = begin + (last - first);
    for (int64_t copy = begin / n; copy * n <= end; ++copy) {
        const auto from = static_cast<uint32_t>(std::max(begin - copy * n, int64_t{0}));
        const auto to = static_cast<uint32_t>(std::min(end - copy * n, n - 1));
        const bool reflected = mirrored && (copy & 1) != 0;
        result.of[result.count++] = reflected ? Segment{size - 1 - to, size - 1 - from} : Segment{from, to};
    }
    return result;
}

Layer::Segments Layer::segments(int64_t first, int64_t last, uint32_t size, image::Wrap wrap) {
    const bool inside = first >= 0 && last < size;
    if (inside || wrap == image::Wrap::clampToEdge) {
        return {{{{wrapped(first, size, image::Wrap::clampToEdge),
                   wrapped(last, size, image::Wrap::clampToEdge)}}},
                1};
    }
    return periodicSegments(first, last, size, wrap == image::Wrap::mirroredRepeat);
}

void Layer::addRow(uint32_t y, const Segments& columns, TexelRange& range) const {
    const uint16_t* row = image_->texels.data() + size_t{y} * width();
    for (unsigned c = 0; c < columns.count; ++c) {
        const Segment run = columns.of[c];
        if (run.first == 0 && run.last + 1 == width()) {
            range.add(rows_[y]);
            continue;
        }
        range.add(rangeOf(row + run.first, run.last + 1 - run.first));
    }
}

}  // namespace filigree::verify
