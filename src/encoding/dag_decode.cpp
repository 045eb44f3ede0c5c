#include "filigree/core/bytes.h"
#include "filigree/encoding/dag.h"
#include "filigree/micromap/quadtree_writer.h"

#include "encoding/checks.h"
#include "encoding/dag_layout.h"

#include <array>
#include <bit>

namespace filigree::encoding {

using micromap::Format;
using micromap::microTriangleCount;

namespace {

uint32_t wordAt(const EncodedView& set, size_t at) {
    return loadLe<uint32_t>(set.payload.data() + dag::wordBytes * at);
}

// Finds every node from its references, which all lie behind it, and proves that nodes fill the payload
// without gaps, each read in one way only.
class NodeCheck {
  public:
    explicit NodeCheck(const EncodedView& set)
        : set_(set), heights_(set.payload.size() / dag::wordBytes), opaque_(heights_.size()) {}

    Status run() {
        if (auto status = markRoots(); !status) return status;
        if (auto status = checkPlaces(); !status) return status;
        if (auto status = checkContents(); !status) return status;
        return checkRootsAreNarrow();
    }

    uint64_t heads = 0;
    uint64_t pointers = 0;
    uint64_t masks = 0;  // words
    uint64_t paddingBits = 0;

  private:
    [[nodiscard]] uint32_t descriptor(uint32_t map) const {
        return loadLe<uint32_t>(set_.descriptors.data() + dag::descriptorBytes * map);
    }
    [[nodiscard]] unsigned presentOf(size_t node) const {
        return static_cast<unsigned>(std::popcount(wordAt(set_, node) & dag::childBits));
    }
    [[nodiscard]] size_t endOf(size_t node) const {
        const unsigned present = presentOf(node);
        return node + 1 +
               (heights_[node] == dag::leafHeight ? dag::maskWords(present, set_.format) : present);
    }

    Status markRoots();
    Status checkPlaces();
    Status markChildren(size_t node);
    Status checkContents();
    Status checkLeaf(size_t leaf);
    void countBelow(size_t node);
    [[nodiscard]] Status checkRootsAreNarrow() const;

    const EncodedView& set_;
    std::vector<uint8_t> heights_;  // by word; 0 where no node is known to start
    std::vector<uint32_t> opaque_;  // by word: micro-triangles of that node on the opaque side
};

Status NodeCheck::markRoots() {
    for (uint32_t map = 0; map < set_.mapCount; ++map) {
        const unsigned level = descriptor(map) >> dag::rootBits;
        const size_t root = descriptor(map) & (dag::maxWords - 1);
        if (level > micromap::maxLevel) {
            return formatError("descriptors: map {}: level {}, expected at most {}", map, level,
                               micromap::maxLevel);
        }
        if (root >= heights_.size()) {
            return formatError("descriptors: map {}: root {}, expected below {}, the payload's words", map,
                               root, heights_.size());
        }
        const unsigned height = dag::rootHeight(level);
        if (heights_[root] != 0 && heights_[root] != height) {
            return formatError("descriptors: map {}: root {} has height {}, an earlier map reads it as {}",
                               map, root, height, heights_[root]);
        }
        heights_[root] = static_cast<uint8_t>(height);
    }
    return {};
}

Status NodeCheck::checkPlaces() {
    size_t end = heights_.size();
    for (size_t node = heights_.size(); node-- > 0;) {
        if (heights_[node] == 0) continue;
        if (endOf(node) != end) {
            return formatError("payload: byte {}: the node there ends at byte {}, expected {}",
                               dag::wordBytes * node, dag::wordBytes * endOf(node), dag::wordBytes * end);
        }
        ++heads;
        if (heights_[node] > dag::leafHeight) {
            pointers += end - node - 1;
            if (auto status = markChildren(node); !status) return status;
        } else {
            masks += end - node - 1;
        }
        end = node;
    }
    if (end == 0) return {};
    return formatError("payload: bytes 0 to {} belong to no node", dag::wordBytes * end);
}

Status NodeCheck::markChildren(size_t node) {
    const auto height = static_cast<uint8_t>(heights_[node] - 2);
    for (size_t at = node + 1; at < endOf(node); ++at) {
        const uint32_t child = wordAt(set_, at);
        const size_t byte = dag::wordBytes * at;
        if (child >= node) {
            return formatError("payload: byte {}: pointer to word {}, expected below {}", byte, child, node);
        }
        if (heights_[child] != 0 && heights_[child] != height) {
            return formatError("payload: byte {}: word {} is a node of height {}, expected {}", byte, child,
                               heights_[child], height);
        }
        if (presentOf(child) == 0) {
            return formatError("payload: byte {}: pointer to word {}, a node without children", byte, child);
        }
        heights_[child] = height;
    }
    return {};
}

// Children stand before their parents, so their counts are known in time.
Status NodeCheck::checkContents() {
    for (size_t node = 0; node < heights_.size(); ++node) {
        if (heights_[node] == 0) continue;
        if (heights_[node] == dag::leafHeight) {
            if (auto status = checkLeaf(node); !status) return status;
        } else {
            for (size_t at = node + 1; at < endOf(node); ++at) opaque_[node] += opaque_[wordAt(set_, at)];
        }
        const uint32_t found = wordAt(set_, node) >> dag::children;
        const uint32_t expected = dag::shareOf(opaque_[node], heights_[node]);
        if (found != expected) {
            return formatError("payload: byte {}: opaque share {}, expected {}", dag::wordBytes * node, found,
                               expected);
        }
    }
    return {};
}

Status NodeCheck::checkLeaf(size_t leaf) {
    const bool wide = set_.format == Format::fourState;
    const unsigned present = presentOf(leaf);
    for (unsigned k = 0; k < present; ++k) {
        const size_t at = leaf + 1 + (wide ? k : k / 2);
        const uint32_t mask = wide ? wordAt(set_, at) : (wordAt(set_, at) >> (16 * (k % 2))) & 0xffff;
        if (mask == 0) {
            return formatError("payload: byte {}: a mask without a set bit, expected an absent child",
                               dag::wordBytes * at);
        }
        opaque_[leaf] += static_cast<uint32_t>(std::popcount(wide ? mask & 0x55555555 : mask));
    }
    if (wide || present % 2 == 0) return {};
    paddingBits += 16;
    const size_t last = leaf + 1 + present / 2;
    if (wordAt(set_, last) >> 16 == 0) return {};
    return formatError("payload: byte {}: padding {:#x}, expected 0", dag::wordBytes * last + 2,
                       wordAt(set_, last) >> 16);
}

// A root holds no more than the 4^level micro-triangles of its map.
Status NodeCheck::checkRootsAreNarrow() const {
    for (uint32_t map = 0; map < set_.mapCount; ++map) {
        const unsigned level = descriptor(map) >> dag::rootBits;
        const size_t root = descriptor(map) & (dag::maxWords - 1);
        const unsigned partHeight = dag::rootHeight(level) - 2;
        const uint64_t parts = level > partHeight ? microTriangleCount(level - partHeight) : 1;
        uint64_t beyond = (wordAt(set_, root) & dag::childBits) >> parts;
        if (level < dag::blockHeight && beyond == 0 && presentOf(root) > 0) {
            beyond = uint64_t{wordAt(set_, root + 1)} >>
                     (microTriangleCount(level) * micromap::bitsPerState(set_.format));
        }
        if (beyond != 0) {
            return formatError("payload: byte {}: the root of map {} holds more than level {} has",
                               dag::wordBytes * root, map, level);
        }
    }
    return {};
}

// What follows mirrors docs/spec/dag.md.
class Decoder {
  public:
    Decoder(const EncodedView& set, BitWriter& to) : set_(set), to_(to) {}

    int root(uint32_t node, unsigned level) {
        const unsigned partHeight = dag::rootHeight(level) - 2;
        if (level >= partHeight) return parts(node, partHeight, level, 0);
        return states(maskOf(node, 0), level, 0);
    }

  private:
    // Children `first` and up of a node, which lie at partHeight, as one part of `height`.
    int parts(uint32_t node, unsigned partHeight, unsigned height, unsigned first) {
        if (height == partHeight) return child(node, partHeight, first);
        const auto quarter = static_cast<unsigned>(microTriangleCount(height - 1 - partHeight));
        return micromap::appendInner(to_, height, [&](unsigned k) {
            return parts(node, partHeight, height - 1, first + k * quarter);
        });
    }

    int child(uint32_t node, unsigned height, unsigned k) {
        const uint32_t head = wordAt(set_, node);
        if (((head >> k) & 1) == 0) return micromap::appendLeaf(to_, height, 0);
        if (height == dag::blockHeight) return states(maskOf(node, k), height, 0);
        return parts(wordAt(set_, node + 1 + filigree_rank16(head, k)), height - 2, height, 0);
    }

    // The mask of child k of a leaf, 0 where it is absent.
    [[nodiscard]] uint32_t maskOf(uint32_t leaf, unsigned k) const {
        const uint32_t head = wordAt(set_, leaf);
        if (((head >> k) & 1) == 0) return 0;
        const uint32_t rank = filigree_rank16(head, k);
        if (set_.format == Format::fourState) return wordAt(set_, leaf + 1 + rank);
        return (wordAt(set_, leaf + 1 + rank / 2) >> (16 * (rank % 2))) & 0xffff;
    }

    // States `first` and up of a mask.
    int states(uint32_t mask, unsigned height, unsigned first) {
        if (height == 0) {
            const unsigned bits = micromap::bitsPerState(set_.format);
            return micromap::appendLeaf(to_, 0,
                                        static_cast<int>((mask >> (bits * first)) & ((1u << bits) - 1)));
        }
        const auto quarter = static_cast<unsigned>(microTriangleCount(height - 1));
        return micromap::appendInner(
            to_, height, [&](unsigned k) { return states(mask, height - 1, first + k * quarter); });
    }

    const EncodedView& set_;
    BitWriter& to_;
};

}  // namespace

Result<DagReader> DagReader::open(const EncodedView& set) {
    if (const auto size = checkDescriptorBytes(set, dag::descriptorBytes); !size) return size.error();
    if (set.payload.size() % dag::wordBytes != 0) {
        return formatError("payload: {} bytes, expected a multiple of {}", set.payload.size(),
                           dag::wordBytes);
    }
    if (set.payload.size() > dag::maxWords * dag::wordBytes) {
        return formatError("payload: {} bytes, expected at most {}", set.payload.size(),
                           dag::maxWords * dag::wordBytes);
    }
    NodeCheck check(set);
    if (const auto status = check.run(); !status) return status.error();
    return DagReader(set, openedAs<filigree_dag>(filigree_dag_open, set),
                     {check.heads, check.pointers, check.masks, check.paddingBits});
}

micromap::Quadtree DagReader::decode(uint32_t map) const {
    BitWriter stream;
    Decoder(set_, stream).root(descriptor(map) & dag::rootMask, level(map));
    return {std::move(stream), level(map)};
}

std::vector<Part> DagReader::parts() const {
    return {{"child masks", 16 * words_.heads}, {"opaque shares", 16 * words_.heads},
            {"pointers", 32 * words_.pointers}, {"state masks", 32 * words_.masks - words_.paddingBits},
            {"padding", words_.paddingBits},    {"descriptors", 8 * uint64_t{set_.descriptors.size()}}};
}

}  // namespace filigree::encoding
