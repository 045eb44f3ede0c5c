#include "io/zstd_bytes.h"

#include <algorithm>
#include <memory>
#include <new>

#include <fmt/format.h>
#include <zstd.h>

namespace filigree::io {
namespace {

constexpr int compressionLevel = 16;
constexpr size_t firstBytes = size_t{1} << 16;

}  // namespace

std::vector<uint8_t> zstdCompress(std::span<const uint8_t> plain) {
    std::vector<uint8_t> frame(ZSTD_compressBound(plain.size()));
    const size_t size =
        ZSTD_compress(frame.data(), frame.size(), plain.data(), plain.size(), compressionLevel);
    if (ZSTD_isError(size) != 0) throw std::bad_alloc();  // nothing else can fail within the bound
    frame.resize(size);
    return frame;
}

Result<std::vector<uint8_t>> zstdDecompress(std::span<const uint8_t> frame, uint64_t plainBytes) {
    const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                            &ZSTD_freeDStream);
    if (!stream) throw std::bad_alloc();
    std::vector<uint8_t> plain(std::min<uint64_t>(plainBytes, firstBytes));
    ZSTD_inBuffer in{frame.data(), frame.size(), 0};
    ZSTD_outBuffer out{plain.data(), plain.size(), 0};
    for (;;) {
        const size_t before = in.pos + out.pos;
        const size_t left = ZSTD_decompressStream(stream.get(), &out, &in);
        if (ZSTD_isError(left) != 0)
            return Error{ErrorKind::format, fmt::format("byte {}: {}", in.pos, ZSTD_getErrorName(left))};
        if (left == 0) break;
        if (out.pos == out.size && out.size < plainBytes) {
            plain.resize(std::min<uint64_t>(plainBytes, 2 * plain.size()));
            out.dst = plain.data();
            out.size = plain.size();
        } else if (in.pos + out.pos == before) {
            return Error{ErrorKind::format,
                         fmt::format("byte {}: the zstd frame {}", in.pos,
                                     in.pos == in.size ? "ends early" : "holds more than is stated")};
        }
    }
    if (in.pos != in.size || out.pos != plainBytes) {
        return Error{ErrorKind::format,
                     fmt::format("the zstd frame has {} of {} bytes and holds {} of {} stated", in.pos,
                                 in.size, out.pos, plainBytes)};
    }
    return plain;
}

}  // namespace filigree::io
