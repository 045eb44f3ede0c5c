#include "vulkan/decoders.h"

#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/map_reader.h"

#include <array>

namespace filigree::vulkan {

using encoding::Encoding;
using quadmap::SquareFormat;

Decoder decoderOf(Encoding encoding) {
    constexpr std::array<Decoder, encoding::encodingCount> decoders{
        Decoder::flat,        Decoder::gruen, Decoder::bitmask, Decoder::tree,
        Decoder::indexedTree, Decoder::dag,   Decoder::sdag};
    return decoders[static_cast<size_t>(encoding)];
}

Result<Decoder> decoderOf(SquareFormat format) {
    switch (format) {
        case SquareFormat::vq2:
            return Decoder::vq2;
        case SquareFormat::vq2Plus:
            return Decoder::vq2Plus;
        case SquareFormat::vq4:
            return Decoder::vq4;
        case SquareFormat::vq4Plus:
            return Decoder::vq4Plus;
        default:
            return Error{ErrorKind::unsupported, "raw squares have no shader"};
    }
}

Status checkSet(const encoding::EncodedView& set) {
    if (set.descriptors.size() >= uint64_t{1} << 29)
        return Error{ErrorKind::limit, "the descriptors take 512 MiB or more, which shaders cannot number"};
    if (set.encoding == Encoding::bitmask) {
        const auto reader = encoding::BitmaskReader::open(set);
        return reader ? Status() : Status(reader.error());
    }
    const auto reader = encoding::openReader(set);
    return reader ? Status() : Status(reader.error());
}

}  // namespace filigree::vulkan
