#include "filigree/core/bits.h"
#include "filigree/core/bytes.h"
#include "filigree/core/stage.h"
#include "filigree/encoding/sdag.h"

#include "encoding/checks.h"
#include "encoding/sdag_codes.h"
#include "encoding/sdag_graph.h"
#include "encoding/sdag_layout.h"
#include "encoding/sdag_orient.h"
#include "encoding/sdag_place.h"
#include "encoding/sdag_shares.h"
#include "encoding/sdag_sparse.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace filigree::encoding {

using micromap::Format;
using micromap::QuadtreeView;

namespace {

using namespace sdag;

// A set on its way. Maps that are not `coded` are stored flat.
struct Work {
    std::span<const QuadtreeView> maps;
    Format format = Format::fourState;
    std::vector<SparseMap> sparse;
    std::vector<uint8_t> symmetries;
    std::vector<bool> coded;
};

std::vector<SparseMap> sparseMaps(std::span<const QuadtreeView> maps, Format format,
                                  const Executor& executor) {
    std::vector<SparseMap> sparse(maps.size());
    executor.parallelFor(maps.size(), 4, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) sparse[k] = sparseMap(maps[k], format);
    });
    return sparse;
}

std::vector<uint8_t> sizesOf(const std::vector<Leaf>& leaves, const LeafCoder& coder,
                             const Executor& executor) {
    std::vector<uint8_t> sizes(leaves.size());
    executor.parallelFor(leaves.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) sizes[k] = static_cast<uint8_t>(coder.bytes(leaves[k]));
    });
    return sizes;
}

// Bytes that each node of a graph would take with all below it if nothing were shared.
class AloneBytes {
  public:
    AloneBytes(const Graph& graph, std::span<const uint8_t> leafBytes, unsigned nodeBytes)
        : leafBytes_(leafBytes) {
        for (unsigned slot = 0; slot < nodeHeights; ++slot) {
            const Layer& layer = graph.layers[slot];
            for (const Node& node : layer.nodes) {
                uint64_t sum = nodeBytes;
                for (const uint32_t child : layer.group(node.group)) {
                    sum += slot == 0 ? 1u + leafBytes[child] : nodes_[slot - 1][child];
                }
                nodes_[slot].push_back(sum);
            }
        }
    }

    [[nodiscard]] uint64_t of(const Root& root) const {
        return root.height == leafHeight ? leafBytes_[root.number]
                                         : nodes_[heightSlot(root.height)][root.number];
    }

  private:
    std::span<const uint8_t> leafBytes_;
    std::array<std::vector<uint64_t>, nodeHeights> nodes_;
};

// A graph with all that is needed to write it.
struct Coded {
    Graph graph;
    LeafCoder coder;
    std::vector<uint8_t> leafBytes;
    Placement placement;
    unsigned baseBytes = 0;
};

unsigned bytesFor(uint64_t largest) {
    return (static_cast<unsigned>(std::bit_width(largest)) + 7) / 8;
}

Coded codeMaps(const Work& work, const Executor& executor) {
    Graph graph = mergeMaps(work.sparse, work.coded, executor);
    LeafCoder coder(graph.leaves, work.format);
    std::vector<uint8_t> leafBytes = sizesOf(graph.leaves, coder, executor);
    Placement placement = place(graph, leafBytes, work.coded);
    uint64_t largest = placement.blockBytes;
    for (const auto& nodes : placement.nodes) largest = std::max<uint64_t>(largest, nodes.size());
    return {std::move(graph), std::move(coder), std::move(leafBytes), std::move(placement),
            bytesFor(largest)};
}

// Maps that take no less than flat become flat; false when there is none.
bool dropLargeMaps(Work& work, const Coded& coded) {
    const AloneBytes alone(coded.graph, coded.leafBytes, 4 + coded.baseBytes);
    bool dropped = false;
    for (size_t k = 0; k < work.maps.size(); ++k) {
        if (!work.coded[k]) continue;
        if (alone.of(coded.graph.roots[k]) <= micromap::flatBytes(work.maps[k].level, work.format)) continue;
        work.coded[k] = false;
        dropped = true;
    }
    return dropped;
}

Head headOf(const Work& work, const Coded& coded, bool shares) {
    const Placement& placement = coded.placement;
    Head head;
    head.shares = shares ? 1 : 0;
    head.base_bytes = coded.baseBytes;
    head.reference_bits = placement.referenceBits;
    head.patterns = static_cast<uint32_t>(coded.coder.patterns().values().size());
    head.heads = static_cast<uint32_t>(coded.coder.heads().values().size());
    for (unsigned slot = 0; slot < nodeHeights; ++slot) {
        head.nodes[slot] = static_cast<uint32_t>(placement.nodes[slot].size());
    }
    head.shared_bytes = static_cast<uint32_t>(placement.sharedBytes);
    head.block_bytes = static_cast<uint32_t>(placement.blockBytes);
    for (size_t k = 0; k < work.maps.size(); ++k) {
        head.levels |= 1u << work.maps[k].level;
        if (work.coded[k]) continue;
        head.flat_maps = 1;
        head.flat_bytes += micromap::flatBytes(work.maps[k].level, work.format);
    }
    return head;
}

// What a descriptor's value says of each map: a shared leaf's address, a node's number, or a flat map's
// offset.
std::vector<uint32_t> valuesOf(const Work& work, const Coded& coded) {
    std::array<std::vector<uint32_t>, nodeHeights> numbers;
    for (unsigned slot = 0; slot < nodeHeights; ++slot) {
        numbers[slot].resize(coded.graph.layers[slot].nodes.size());
        const auto& nodes = coded.placement.nodes[slot];
        for (size_t at = nodes.size(); at-- > 0;) numbers[slot][nodes[at]] = static_cast<uint32_t>(at);
    }
    std::vector<uint32_t> values(work.maps.size());
    uint64_t flat = 0;
    for (size_t k = 0; k < values.size(); ++k) {
        const Root& root = coded.graph.roots[k];
        if (!work.coded[k]) {
            values[k] = static_cast<uint32_t>(flat);
            flat += micromap::flatBytes(work.maps[k].level, work.format);
        } else if (root.height == leafHeight) {
            values[k] = coded.placement.leafAddress[root.number];
        } else {
            values[k] = numbers[heightSlot(root.height)][root.number];
        }
    }
    return values;
}

void writeDescriptors(const Work& work, const Head& head, std::span<const uint32_t> values,
                      std::vector<uint8_t>& to) {
    to.resize(head.descriptorBlockBytes(static_cast<uint32_t>(values.size())));
    writeHead(head, to);
    BitWriter bits;
    for (size_t k = 0; k < values.size(); ++k) {
        const uint32_t below = head.levels & ((1u << work.maps[k].level) - 1);
        bits.append(static_cast<unsigned>(std::popcount(below)), head.levelBits());
        if (head.flat_maps != 0) bits.append(work.coded[k] ? 0 : 1, 1);
        bits.append(work.coded[k] ? work.symmetries[k] : 0, symmetryBits);
        bits.append(values[k], head.value_bits);
    }
    const auto bytes = (bits.size() + 7) / 8;
    for (size_t k = 0; k < bytes; ++k) {
        to[Head::bytes + k] = static_cast<uint8_t>(bits.words()[k / 8] >> (8 * (k % 8)));
    }
}

void writeTables(const Coded& coded, Format format, const Offsets& at, uint8_t* payload) {
    const bool twoState = format == Format::twoState;
    uint8_t* to = payload + at.patterns;
    for (const Pattern pattern : coded.coder.patterns().values()) {
        const uint32_t plain = packed(pattern, twoState);
        for (unsigned k = 0; k < patternBytes(format); ++k) *to++ = static_cast<uint8_t>(plain >> (8 * k));
    }
    to = payload + at.heads;
    for (const uint32_t head : coded.coder.heads().values()) {
        storeLe(to, head);
        to += 4;
    }
}

// The bits of a node of height 6 that tell which of its mixed children are shared.
unsigned sharedBits(const Coded& coded, const Node& node) {
    unsigned bits = 0;
    unsigned mixed = node.mixed;
    for (const uint32_t leaf : coded.graph.layers[0].group(node.group)) {
        const unsigned lowest = mixed & (0 - mixed);
        if (coded.placement.isShared[leaf]) bits |= lowest;
        mixed ^= lowest;
    }
    return bits;
}

void writeNodes(const Coded& coded, const Offsets& at, uint8_t* payload) {
    for (unsigned slot = 0; slot < nodeHeights; ++slot) {
        uint8_t* to = payload + at.nodes[slot];
        for (const uint32_t number : coded.placement.nodes[slot]) {
            const Node& node = coded.graph.layers[slot].nodes[number];
            const unsigned shared = slot == 0 ? sharedBits(coded, node) : 0;
            storeLe(to, node.mixed);
            storeLe(to + 2, static_cast<uint16_t>(node.opaque | shared));
            const uint32_t base = node.mixed == 0 ? 0 : coded.placement.groups[slot][node.group];
            for (unsigned k = 0; k < coded.baseBytes; ++k) to[4 + k] = static_cast<uint8_t>(base >> (8 * k));
            to += 4 + coded.baseBytes;
        }
    }
}

void writeShared(const Coded& coded, const Offsets& at, uint8_t* payload) {
    std::vector<uint8_t> bytes;
    bytes.reserve(coded.placement.sharedBytes);
    for (const uint32_t leaf : coded.placement.sharedLeaves)
        coded.coder.append(coded.graph.leaves[leaf], bytes);
    std::ranges::copy(bytes, payload + at.shared);
}

// One block: references, then the leaves that only it has.
void writeBlock(const Coded& coded, std::span<const uint32_t> leaves, uint8_t* to) {
    const Placement& placement = coded.placement;
    unsigned bits = 0;
    for (const uint32_t leaf : leaves) {
        bits += placement.isShared[leaf] ? placement.referenceBits : offsetBits;
    }
    std::vector<uint8_t> own;
    BitWriter references;
    for (const uint32_t leaf : leaves) {
        if (placement.isShared[leaf]) {
            references.append(placement.leafAddress[leaf], placement.referenceBits);
        } else {
            references.append((bits + 7) / 8 + own.size(), offsetBits);
            coded.coder.append(coded.graph.leaves[leaf], own);
        }
    }
    for (unsigned k = 0; k < (bits + 7) / 8; ++k) {
        *to++ = static_cast<uint8_t>(references.words()[k / 8] >> (8 * (k % 8)));
    }
    std::ranges::copy(own, to);
}

void writeBlocks(const Coded& coded, const Offsets& at, uint8_t* payload, const Executor& executor) {
    const auto& blocks = coded.placement.blocks;
    executor.parallelFor(blocks.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            writeBlock(coded, coded.graph.layers[0].group(blocks[k]),
                       payload + at.blocks + coded.placement.groups[0][blocks[k]]);
        }
    });
}

void writeFlatMaps(const Work& work, std::span<const uint32_t> values, const Offsets& at,
                   std::vector<uint8_t>& payload, const Executor& executor) {
    executor.parallelFor(work.maps.size(), 16, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            if (work.coded[k]) continue;
            const uint64_t bytes = micromap::flatBytes(work.maps[k].level, work.format);
            micromap::writeFlat(work.maps[k], work.format,
                                std::span(payload).subspan(at.flat + values[k], bytes));
        }
    });
}

Result<EncodedSet> write(const Work& work, const Coded& coded, bool shares, const Executor& executor) {
    Head head = headOf(work, coded, shares);
    for (const uint64_t bytes : {coded.placement.sharedBytes, coded.placement.blockBytes, head.flat_bytes}) {
        if (const auto reach = checkOffsetsReach(Encoding::sdag, bytes); !reach) return reach.error();
    }
    const auto values = valuesOf(work, coded);
    const uint32_t largest = values.empty() ? 0 : *std::ranges::max_element(values);
    head.value_bits = static_cast<unsigned>(std::bit_width(largest));

    EncodedSet set{Encoding::sdag, work.format, static_cast<uint32_t>(work.maps.size()), {}, {}};
    writeDescriptors(work, head, values, set.descriptors);
    const Offsets at = offsetsOf(head, work.format);
    set.payload.resize(at.end);
    uint8_t* payload = set.payload.data();
    writeTables(coded, work.format, at, payload);
    writeNodes(coded, at, payload);
    if (shares) writeShares(coded.graph, coded.placement, payload + at.shares[0]);
    writeShared(coded, at, payload);
    writeBlocks(coded, at, payload, executor);
    writeFlatMaps(work, values, at, set.payload, executor);
    return set;
}

uint64_t allFlatBytes(const Work& work) {
    return std::accumulate(
        work.maps.begin(), work.maps.end(), uint64_t{0},
        [&](uint64_t sum, const auto& map) { return sum + micromap::flatBytes(map.level, work.format); });
}

}  // namespace

Result<EncodedSet> encodeSdag(std::span<const QuadtreeView> maps, Format format, bool shares,
                              const Executor& executor, ProgressSink& progress) {
    const Stage stage(executor, progress, "encode", maps.size(), "micromaps");
    Work work{maps, format, sparseMaps(maps, format, stage), {}, std::vector<bool>(maps.size(), true)};
    work.symmetries = orient(work.sparse, stage);
    if (const Status status = stage.status(); !status) return status.error();
    // What follows builds on all that came before, so that no loop of it may be left out.
    Coded coded = codeMaps(work, executor);
    if (stage.cancelled()) return stage.status().error();
    if (dropLargeMaps(work, coded)) coded = codeMaps(work, executor);
    if (stage.cancelled()) return stage.status().error();
    // Tables and padding may still outweigh what they save; shares are not counted.
    const Offsets at = offsetsOf(headOf(work, coded, false), format);
    if (at.end > allFlatBytes(work)) {
        work.coded.assign(maps.size(), false);
        coded = codeMaps(work, executor);
    }
    return write(work, coded, shares, executor);
}

}  // namespace filigree::encoding
