// Any bytes as a few micromaps: every encoding gives them back, and the same bytes each time.
#include "filigree/encoding/encode.h"
#include "filigree/encoding/map_reader.h"

#include "encoding/stored.h"

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace filigree;
using encoding::EncodedSet;
using encoding::Encoding;
using micromap::Format;
using micromap::State;

void fail(Encoding encoding, const char* what) {
    std::fprintf(stderr, "%s: %s\n", encoding::nameOf(encoding).data(), what);
    std::abort();
}

// Reads bits from the input; zeros once it has ended.
class Source {
  public:
    Source(const uint8_t* data, size_t size) : data_(data), bits_(8 * size) {}
    [[nodiscard]] bool ended() const { return at_ >= bits_; }
    unsigned take(unsigned count) {
        unsigned value = 0;
        for (unsigned k = 0; k < count && !ended(); ++k, ++at_) {
            value |= (data_[at_ / 8] >> (at_ % 8) & 1u) << k;
        }
        return value;
    }

  private:
    const uint8_t* data_;
    size_t bits_;
    size_t at_ = 0;
};

// A map is read afresh, or is one before it with its vertices in another order, so that sharing is met too.
micromap::Quadtree mapFrom(Source& source, const micromap::QuadtreeList& before) {
    constexpr micromap::VertexOrder orders[] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                                {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    if (before.size() > 0 && source.take(2) == 3) {
        return micromap::permuted(before[source.take(3) % before.size()], orders[source.take(3) % 6]);
    }
    const unsigned level = source.take(3) % 7;
    return tests::build(level, [&](uint64_t, unsigned height) {
        if (height > 0 && source.take(1) != 0) return -1;
        return static_cast<int>(source.take(2));
    });
}

EncodedSet encodeOrFail(Encoding encoding, std::span<const micromap::QuadtreeView> maps, Format format,
                        const encoding::EncodeOptions& options) {
    auto encoded = encoding::encode(encoding, maps, format, options, serialExecutor());
    if (!encoded) fail(encoding, encoded.error().message.c_str());
    return std::move(*encoded);
}

void checkMap(Encoding encoding, const encoding::MapReader& reader, uint32_t map,
              const micromap::QuadtreeView& tree) {
    if (reader.level(map) != tree.level) fail(encoding, "a level is another");
    if (!equal(reader.decode(map).view(), tree)) fail(encoding, "a map is another");
    forEachLeaf(tree, [&](uint64_t first, unsigned depth, State state) {
        const uint64_t last = first + micromap::microTriangleCount(tree.level - depth) - 1;
        if (reader.at(map, static_cast<uint32_t>(first)) != state ||
            reader.at(map, static_cast<uint32_t>(last)) != state) {
            fail(encoding, "at() finds another state");
        }
    });
}

void roundTrip(Encoding encoding, std::span<const micromap::QuadtreeView> maps, Format format,
               const encoding::EncodeOptions& options) {
    const EncodedSet set = encodeOrFail(encoding, maps, format, options);
    const EncodedSet again = encodeOrFail(encoding, maps, format, options);
    if (set.descriptors != again.descriptors || set.payload != again.payload) {
        fail(encoding, "the same maps give other bytes");
    }
    const auto reader = encoding::openReader(encoding::viewOf(set));
    if (!reader) fail(encoding, reader.error().message.c_str());
    for (uint32_t map = 0; map < maps.size(); ++map) {
        checkMap(encoding, **reader, map, tests::storedMap(encoding, format, maps[map]).view());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Source source(data, size);
    const Format format = source.take(1) != 0 ? Format::twoState : Format::fourState;
    const encoding::EncodeOptions options{.aggregates = source.take(1) != 0};
    micromap::QuadtreeList list;
    while (!source.ended() && list.size() < 8) list.push(mapFrom(source, list).view());
    std::vector<micromap::QuadtreeView> maps;
    for (size_t k = 0; k < list.size(); ++k) maps.push_back(list[k]);
    for (const Encoding encoding : tests::testedEncodings) roundTrip(encoding, maps, format, options);
    return 0;
}
