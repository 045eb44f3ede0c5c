#include "filigree/core/bytes.h"
#include "filigree/core/stage.h"
#include "filigree/encoding/flat.h"

#include "encoding/checks.h"

namespace filigree::encoding {
namespace {

void writeRecord(uint8_t* to, uint64_t offset, unsigned level, micromap::Format format) {
    storeLe(to, static_cast<uint32_t>(offset));
    storeLe(to + 4, static_cast<uint16_t>(level));
    storeLe(to + 6, static_cast<uint16_t>(format));
}

}  // namespace

Result<EncodedSet> encodeFlat(std::span<const micromap::QuadtreeView> maps, micromap::Format format,
                              const Executor& executor, ProgressSink& progress) {
    const Stage stage(executor, progress, "encode", maps.size(), "micromaps");
    uint64_t bytes = 0;
    for (const auto& map : maps) bytes += micromap::flatBytes(map.level, format);
    if (const auto reach = checkOffsetsReach(Encoding::flat, bytes); !reach) return reach.error();

    EncodedSet set{Encoding::flat, format, static_cast<uint32_t>(maps.size()), {}, {}};
    set.descriptors.resize(micromap::recordBytes * maps.size());
    set.payload.resize(bytes);
    uint64_t offset = 0;
    for (size_t k = 0; k < maps.size(); ++k) {
        writeRecord(set.descriptors.data() + micromap::recordBytes * k, offset, maps[k].level, format);
        offset += micromap::flatBytes(maps[k].level, format);
    }
    stage.parallelFor(maps.size(), 16, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            const auto at = loadLe<uint32_t>(set.descriptors.data() + micromap::recordBytes * k);
            const auto to = std::span(set.payload).subspan(at, micromap::flatBytes(maps[k].level, format));
            micromap::writeFlat(maps[k], format, to);
        }
        stage.advance(end - begin);
    });
    if (const Status status = stage.status(); !status) return status.error();
    return set;
}

}  // namespace filigree::encoding
