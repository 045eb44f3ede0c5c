#include "filigree/core/bytes.h"
#include "filigree/core/stage.h"
#include "filigree/encoding/bitmask.h"

#include "encoding/bitmask_cells.h"
#include "encoding/bitmask_layout.h"

#include <cmath>

#include <fmt/format.h>

namespace filigree::encoding {
namespace {

using micromap::Format;

constexpr double maxGuard = 8;    // texels
constexpr size_t rowsAtOnce = 8;  // whose bits are whole bytes, so that threads share none

Status checkTest(const image::AlphaTest& test, size_t texture) {
    const auto isUsable = [](double x) { return std::isfinite(x) && x >= 0; };
    if (isUsable(test.cutoff) && isUsable(test.factor) && isUsable(test.guard) && test.guard <= maxGuard) {
        return {};
    }
    return Error{ErrorKind::usage,
                 fmt::format("bitmask: texture {}: cutoff {}, factor {}, guard {}: expected finite numbers "
                             ">= 0, the guard at most {} texels",
                             texture, test.cutoff, test.factor, test.guard, maxGuard)};
}

BitmaskAxis axisOf(uint32_t size, image::Wrap wrap, image::Filter filter) {
    return {size, wrap, filter != image::Filter::nearest};
}

uint64_t maskBytes(const image::AlphaTexture& texture, Format format) {
    return bitmask::maskBytes(axisOf(texture.image.width, texture.wrapU, texture.filter),
                              axisOf(texture.image.height, texture.wrapV, texture.filter), format);
}

void writeDescriptor(const image::AlphaTexture& texture, uint64_t offset, uint8_t* to) {
    storeLe(to, static_cast<uint32_t>(offset));
    storeLe(to + bitmask::widthAt, static_cast<uint16_t>(texture.image.width - 1));
    storeLe(to + bitmask::heightAt, static_cast<uint16_t>(texture.image.height - 1));
    to[bitmask::flagsAt] = static_cast<uint8_t>(
        static_cast<unsigned>(texture.wrapU) | (static_cast<unsigned>(texture.wrapV) << bitmask::wrapVShift) |
        (texture.filter == image::Filter::nearest ? bitmask::nearestFlag : 0));
}

void writeMask(const BitmaskSource& source, Format format, std::span<uint8_t> to, const Stage& stage) {
    const bitmask::Cells cells(source);
    const uint32_t columns = cells.columns().cells();
    const uint32_t rows = cells.rows().cells();
    const unsigned bits = micromap::bitsPerState(format);
    const auto writeRow = [&](uint32_t row) {
        uint64_t bit = uint64_t{row} * columns * bits;
        for (uint32_t column = 0; column < columns; ++column, bit += bits) {
            const auto value = format == Format::fourState ? static_cast<unsigned>(cells.stateOf(column, row))
                                                           : static_cast<unsigned>(cells.sideOf(column, row));
            to[bit / 8] |= static_cast<uint8_t>(value << (bit % 8));
        }
    };
    stage.parallelFor((rows + rowsAtOnce - 1) / rowsAtOnce, 1, [&](size_t begin, size_t end) {
        for (size_t row = begin * rowsAtOnce; row < std::min<size_t>(rows, end * rowsAtOnce); ++row) {
            writeRow(static_cast<uint32_t>(row));
        }
    });
}

}  // namespace

Result<EncodedSet> encodeBitmasks(std::span<const BitmaskSource> sources, Format format,
                                  const Executor& executor, ProgressSink& progress) {
    std::vector<uint64_t> offsets{0};
    for (size_t k = 0; k < sources.size(); ++k) {
        if (const auto usable = image::check(sources[k].texture->image); !usable) return usable.error();
        if (const auto usable = checkTest(sources[k].test, k); !usable) return usable.error();
        offsets.push_back(offsets.back() + maskBytes(*sources[k].texture, format));
    }
    if (offsets.back() > UINT32_MAX) {
        return Error{ErrorKind::limit,
                     fmt::format("bitmask: the textures take {} bytes, its offsets reach {}", offsets.back(),
                                 UINT32_MAX)};
    }
    EncodedSet set{Encoding::bitmask, format, static_cast<uint32_t>(sources.size()), {}, {}};
    set.descriptors.resize(bitmask::descriptorBytes * sources.size());
    set.payload.resize(offsets.back());
    const Stage stage(executor, progress, "encode", sources.size(), "textures");
    for (size_t k = 0; k < sources.size(); ++k) {
        writeDescriptor(*sources[k].texture, offsets[k],
                        set.descriptors.data() + bitmask::descriptorBytes * k);
        writeMask(sources[k], format, std::span(set.payload).subspan(offsets[k], offsets[k + 1] - offsets[k]),
                  stage);
        if (const Status status = stage.status(); !status) return status.error();
        stage.advance(1);
    }
    return set;
}

}  // namespace filigree::encoding
