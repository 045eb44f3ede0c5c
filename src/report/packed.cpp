#include "report/packed.h"

#include "report/text.h"

#include <new>

#include <zlib.h>

namespace filigree::report {

std::string packed(std::span<const uint8_t> bytes) {
    std::vector<uint8_t> out(compressBound(bytes.size()));
    uLongf size = out.size();
    // Out of memory is the one failure left with room for the worst case.
    if (compress2(out.data(), &size, bytes.data(), bytes.size(), Z_BEST_COMPRESSION) != Z_OK)
        throw std::bad_alloc();
    return base64(std::span(out).first(size));
}

}  // namespace filigree::report
