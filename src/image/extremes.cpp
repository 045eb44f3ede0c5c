#include "filigree/image/extremes.h"

#include <algorithm>
#include <array>

namespace filigree::image {
namespace {

// A stretch of an image axis.
struct Stretch {
    int64_t first = 0;
    int64_t last = 0;
};

// Up to two stretches of [0, size) that hold what the unwrapped [first, last] reads.
struct Stretches {
    std::array<Stretch, 2> part{};
    size_t count = 1;
};

int64_t floorMod(int64_t a, int64_t n) {
    return ((a % n) + n) % n;
}

Stretches wrapped(int64_t first, int64_t last, int64_t size, Wrap wrap) {
    if (wrap == Wrap::clampToEdge) {
        return {{{{std::clamp<int64_t>(first, 0, size - 1), std::clamp<int64_t>(last, 0, size - 1)}, {}}}, 1};
    }
    if (last - first + 1 >= size) return {{{{0, size - 1}, {}}}, 1};
    if (wrap == Wrap::repeat) {
        const int64_t from = floorMod(first, size);
        const int64_t to = from + (last - first);
        if (to < size) return {{{{from, to}, {}}}, 1};
        return {{{{from, size - 1}, {0, to - size}}}, 2};
    }
    const int64_t from = wrapTexel(first, static_cast<uint32_t>(size), wrap);
    const int64_t to = wrapTexel(last, static_cast<uint32_t>(size), wrap);
    // Turning round at a border reads everything up to it.
    const int64_t start = floorMod(first, 2 * size);
    const int64_t end = start + (last - first);
    const Stretch hull{std::min(from, to), std::max(from, to)};
    if (start < size && end >= size) return {{{{hull.first, size - 1}, {}}}, 1};
    if (start >= size && end >= 2 * size) return {{{{0, hull.last}, {}}}, 1};
    return {{{hull, {}}}, 1};
}

}  // namespace

TexelExtremes::TexelExtremes(const AlphaTexture& texture) : texture_(&texture) {
    const AlphaImage& image = texture.image;
    const auto halved = [](uint32_t size) { return (size + 1) / 2; };
    Level first{halved(image.width), halved(image.height), {}};
    first.blocks.resize(size_t{first.width} * first.height);
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const uint16_t texel = image.at(x, y);
            first.blocks[size_t{y / 2} * first.width + x / 2].add({texel, texel});
        }
    }
    levels_.push_back(std::move(first));
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        const Level& finer = levels_.back();
        Level next{halved(finer.width), halved(finer.height), {}};
        next.blocks.resize(size_t{next.width} * next.height);
        for (uint32_t y = 0; y < finer.height; ++y) {
            for (uint32_t x = 0; x < finer.width; ++x) {
                next.blocks[size_t{y / 2} * next.width + x / 2].add(
                    finer.blocks[size_t{y} * finer.width + x]);
            }
        }
        levels_.push_back(std::move(next));
    }
}

TexelRange TexelExtremes::over(int64_t x0, int64_t x1, int64_t y0, int64_t y1) const {
    const Stretches columns = wrapped(x0, x1, texture_->image.width, texture_->wrapU);
    const Stretches rows = wrapped(y0, y1, texture_->image.height, texture_->wrapV);
    TexelRange range;
    for (size_t r = 0; r < rows.count; ++r) {
        for (size_t c = 0; c < columns.count; ++c) {
            range.add(overImage(columns.part[c].first, columns.part[c].last, rows.part[r].first,
                                rows.part[r].last));
        }
    }
    return range;
}

TexelRange TexelExtremes::overImage(int64_t x0, int64_t x1, int64_t y0, int64_t y1) const {
    TexelRange range;
    if (x1 - x0 < 4 && y1 - y0 < 4) {
        for (int64_t y = y0; y <= y1; ++y) {
            for (int64_t x = x0; x <= x1; ++x) {
                const uint16_t texel = texture_->image.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
                range.add({texel, texel});
            }
        }
        return range;
    }
    // The level at which the rectangle meets few blocks.
    size_t level = 0;
    while (level + 1 < levels_.size() && std::max(x1 - x0, y1 - y0) >> (level + 1) >= 4) ++level;
    const Level& blocks = levels_[level];
    for (int64_t y = y0 >> (level + 1); y <= y1 >> (level + 1); ++y) {
        for (int64_t x = x0 >> (level + 1); x <= x1 >> (level + 1); ++x) {
            range.add(blocks.blocks[static_cast<size_t>(y) * blocks.width + static_cast<size_t>(x)]);
        }
    }
    return range;
}

}  // namespace filigree::image
