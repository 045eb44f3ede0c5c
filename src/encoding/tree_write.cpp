#include "encoding/tree_write.h"

#include "filigree/core/stage.h"

#include "encoding/checks.h"
#include "encoding/sides.h"
#include "encoding/tree_layout.h"

#include <algorithm>

namespace filigree::encoding {

using micromap::Format;
using micromap::Quadtree;
using micromap::QuadtreeView;
using micromap::State;

namespace {

// use(map as the format keeps it).
template <class Use>
void withStored(const QuadtreeView& map, Format format, Use&& use) {
    if (format == Format::fourState) return use(map);
    const Quadtree sides = sidesOf(map);
    use(sides.view());
}

uint32_t innerCount(const QuadtreeView& tree) {
    uint32_t leaves = 0;
    forEachLeaf(tree, [&](uint64_t, unsigned, State) { ++leaves; });
    return leaves / 3;
}

void copyBytes(const BitWriter& from, std::span<uint8_t> to) {
    for (size_t k = 0; k < to.size(); ++k) to[k] = static_cast<uint8_t>(from.words()[k / 8] >> (k % 8 * 8));
}

// Algorithm 2: structure and values, depth first.
void writeStrings(const QuadtreeView& tree, Format format, std::span<uint8_t> structureTo,
                  std::span<uint8_t> valuesTo) {
    BitWriter structure;
    BitWriter values;
    forEachLeaf(tree, [&](uint64_t first, unsigned depth, State state) {
        const unsigned above = depth - topDepth(first, tree.level);
        structure.append((uint64_t{1} << above) - 1, above + 1);
        values.append(static_cast<uint64_t>(state), micromap::bitsPerState(format));
    });
    copyBytes(structure, structureTo);
    copyBytes(values, valuesTo);
}

uint64_t stringBytes(uint64_t inner, Format format) {
    return structureBytes(inner) + valueBytes(inner, format);
}

}  // namespace

Result<EncodedSet> writeTrees(Encoding encoding, std::span<const QuadtreeView> maps, Format format,
                              const TreeExtras& extras, const Executor& executor, ProgressSink& progress) {
    const Stage stage(executor, progress, "encode", maps.size(), "micromaps");
    std::vector<uint32_t> inner(maps.size());
    stage.parallelFor(maps.size(), 16, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            withStored(maps[k], format, [&](const QuadtreeView& map) { inner[k] = innerCount(map); });
        }
    });
    std::vector<uint64_t> offsets(maps.size() + 1, 0);
    for (size_t k = 0; k < maps.size(); ++k) {
        offsets[k + 1] = offsets[k] + stringBytes(inner[k], format) + extras.bytes(inner[k], maps[k].level);
    }
    const uint64_t bytes = offsets.back() + extras.tailBytes;
    if (const auto reach = checkOffsetsReach(encoding, bytes); !reach) return reach.error();

    EncodedSet set{encoding, format, static_cast<uint32_t>(maps.size()), {}, {}};
    set.descriptors.resize(treeDescriptorBytes * maps.size());
    set.payload.resize(bytes);
    stage.parallelFor(maps.size(), 16, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            storeTreeDescriptor(set.descriptors.data() + treeDescriptorBytes * k,
                                {static_cast<uint32_t>(offsets[k]), inner[k], maps[k].level});
            const auto to = std::span(set.payload).subspan(offsets[k], offsets[k + 1] - offsets[k]);
            const uint64_t structure = structureBytes(inner[k]);
            const uint64_t values = valueBytes(inner[k], format);
            withStored(maps[k], format, [&](const QuadtreeView& map) {
                writeStrings(map, format, to.first(structure), to.subspan(structure, values));
                extras.write(map, to.subspan(structure + values));
            });
        }
        stage.advance(end - begin);
    });
    if (const Status status = stage.status(); !status) return status.error();
    return set;
}

}  // namespace filigree::encoding
