// Everything that must hold before lookups may trust the bytes of an sdag.
#include "filigree/core/bytes.h"
#include "filigree/encoding/sdag.h"

#include "encoding/checks.h"
#include "encoding/sdag_layout.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

namespace filigree::encoding {

using micromap::Format;

namespace {

using namespace sdag;

Status checkHead(const Head& head, const EncodedView& set) {
    if ((set.descriptors[0] & ~3u) != 0) {
        return formatError("descriptors: byte 0: flags {}, expected at most 3", set.descriptors[0]);
    }
    if (head.base_bytes > 4 || head.reference_bits > 32 || head.value_bits > 32) {
        return formatError("descriptors: bytes 1 to 3: widths {}, {}, {}, expected at most 4, 32, 32",
                           head.base_bytes, head.reference_bits, head.value_bits);
    }
    if ((head.reference_bits == 0) != (head.shared_bytes == 0)) {
        return formatError("descriptors: byte 2: references of {} bits to {} bytes of leaves",
                           head.reference_bits, head.shared_bytes);
    }
    if (head.levels >> (micromap::maxLevel + 1) != 0 || (head.levels == 0) != (set.mapCount == 0)) {
        return formatError("descriptors: byte 4: levels {:#x} for {} maps", head.levels, set.mapCount);
    }
    if (head.patterns > codeLimit || head.heads > codeLimit) {
        return formatError("descriptors: byte 8: tables of {} and {}, expected at most {}", head.patterns,
                           head.heads, codeLimit);
    }
    if ((head.flat_maps != 0) != (head.flat_bytes != 0) || head.flat_bytes > set.payload.size()) {
        return formatError("descriptors: byte 40: {} bytes of flat maps in a payload of {}", head.flat_bytes,
                           set.payload.size());
    }
    return {};
}

Status checkSizes(const Head& head, const Offsets& at, const EncodedView& set) {
    const uint64_t expected = head.descriptorBlockBytes(set.mapCount);
    if (set.descriptors.size() != expected) {
        return formatError("descriptors: {} bytes, expected {} for {} maps", set.descriptors.size(), expected,
                           set.mapCount);
    }
    if (set.payload.size() != at.end) {
        return formatError("payload: {} bytes, expected {}", set.payload.size(), at.end);
    }
    return {};
}

Status checkZero(std::span<const uint8_t> bytes, std::string_view block, uint64_t first) {
    const auto set = std::ranges::find_if(bytes, [](uint8_t byte) { return byte != 0; });
    if (set == bytes.end()) return {};
    return formatError("{}: byte {}: {}, expected 0", block,
                       first + static_cast<uint64_t>(set - bytes.begin()), *set);
}

// Walks over all that the payload holds, in file order, where there is one.
class Checker {
  public:
    Checker(const EncodedView& set, const Head& head, const Offsets& at)
        : set_(set), head_(head), at_(at), payload_(set.payload.data()) {}

    Status run() {
        if (auto heads = checkHeads(); !heads) return heads;
        if (auto leaves = checkShared(); !leaves) return leaves;
        if (auto nodes = checkNodes(); !nodes) return nodes;
        if (auto blocks = checkBlocks(); !blocks) return blocks;
        if (auto maps = checkMaps(); !maps) return maps;
        const auto pad = set_.payload.subspan(at_.padding, at_.flat - at_.padding);
        return checkZero(pad, "payload", at_.padding);
    }

    // Bytes of the blocks that are references.
    [[nodiscard]] uint64_t referenceBytes() const { return referenceBytes_; }

  private:
    // The node of height 6 that a block belongs to, or one of them.
    struct Block {
        uint32_t base = 0;
        uint32_t mixed = 0;
        uint32_t shared = 0;
        uint64_t place = 0;  // of the node in the payload

        // Which children are shared, by rank.
        [[nodiscard]] uint32_t kinds() const {
            uint32_t bits = 0;
            unsigned rank = 0;
            for (unsigned k = 0; k < 16; ++k) {
                if (((mixed >> k) & 1) == 0) continue;
                bits |= ((shared >> k) & 1) << rank++;
            }
            return bits;
        }
        [[nodiscard]] unsigned count() const { return static_cast<unsigned>(std::popcount(mixed)); }
    };

    Status checkHeads() const {
        for (uint32_t k = 0; k < head_.heads; ++k) {
            const auto head = loadLe<uint32_t>(payload_ + at_.heads + uint64_t{4} * k);
            if ((head & (head >> 16)) != 0) {
                return formatError("payload: byte {}: head {}: a child is both mixed and opaque",
                                   at_.heads + uint64_t{4} * k, k);
            }
        }
        return {};
    }

    Status checkShared() {
        isShared_.resize(head_.shared_bytes);
        uint64_t place = at_.shared;
        while (place < at_.blocks) {
            isShared_[place - at_.shared] = true;
            const auto next = leafEnd(place, at_.blocks);
            if (!next) return next.error();
            place = *next;
        }
        return {};
    }

    Status checkNodes() {
        for (unsigned slot = 0; slot < nodeHeights; ++slot) {
            for (uint32_t k = 0; k < head_.nodes[slot]; ++k) {
                const uint64_t place = at_.nodes[slot] + uint64_t{k} * head_.nodeBytes();
                if (auto node = checkNode(slot, place); !node) return node;
            }
        }
        return {};
    }

    Status checkNode(unsigned slot, uint64_t place) {
        const uint32_t mixed = loadLe<uint16_t>(payload_ + place);
        const uint32_t opaque = loadLe<uint16_t>(payload_ + place + 2);
        uint32_t base = 0;
        for (unsigned k = 0; k < head_.base_bytes; ++k) base |= uint32_t{payload_[place + 4 + k]} << (8 * k);
        if (mixed == 0) {
            if (base == 0) return {};
            return formatError("payload: byte {}: node without mixed children has base {}", place, base);
        }
        if (slot == 0) {
            blocks_.push_back({base, mixed, mixed & opaque, place});
            return {};
        }
        if ((mixed & opaque) != 0) {
            return formatError("payload: byte {}: a child is both mixed and opaque", place);
        }
        const auto count = static_cast<unsigned>(std::popcount(mixed));
        if (uint64_t{base} + count > head_.nodes[slot - 1]) {
            return formatError("payload: byte {}: nodes {} to {}, expected below {}", place, base,
                               uint64_t{base} + count - 1, head_.nodes[slot - 1]);
        }
        return {};
    }

    Status checkBlocks() {
        std::ranges::stable_sort(blocks_, {}, &Block::base);
        uint64_t end = 0;
        for (size_t k = 0; k < blocks_.size(); ++k) {
            const Block& block = blocks_[k];
            if (k > 0 && blocks_[k - 1].base == block.base) {
                if (blocks_[k - 1].kinds() == block.kinds() && blocks_[k - 1].count() == block.count())
                    continue;
                return formatError("payload: byte {}: node reads the block at {} unlike another", block.place,
                                   block.base);
            }
            if (block.base != end) {
                return formatError("payload: byte {}: block at {}, expected at {}", block.place, block.base,
                                   end);
            }
            const auto next = blockEnd(block);
            if (!next) return next.error();
            end = *next;
        }
        if (end == head_.block_bytes) return {};
        return formatError("payload: blocks of {} bytes, expected {}", head_.block_bytes, end);
    }

    Result<uint64_t> blockEnd(const Block& block) {
        const uint32_t kinds = block.kinds();
        const auto shared = static_cast<unsigned>(std::popcount(kinds));
        const unsigned bits = 8 * (block.count() - shared) + head_.reference_bits * shared;
        const uint64_t begin = at_.blocks + block.base;
        const uint64_t bytes = (bits + 7) / 8;
        if (begin + bytes > at_.padding) return formatError("payload: byte {}: block is cut short", begin);
        referenceBytes_ += bytes;
        uint64_t own = begin + bytes;
        unsigned bit = 0;
        for (unsigned rank = 0; rank < block.count(); ++rank) {
            const bool isOwn = ((kinds >> rank) & 1) == 0;
            const unsigned width = isOwn ? 8 : head_.reference_bits;
            const uint64_t reference = bitsAt(begin, bit, width);
            bit += width;
            if (!isOwn) {
                if (reference < isShared_.size() && isShared_[reference]) continue;
                return formatError("payload: byte {}: no leaf at {}", begin, reference);
            }
            if (reference != own - begin) {
                return formatError("payload: byte {}: leaf at {}, expected at {}", begin, reference,
                                   own - begin);
            }
            const auto next = leafEnd(own, at_.padding);
            if (!next) return next.error();
            own = *next;
        }
        if (bitsAt(begin, bit, static_cast<unsigned>(8 * bytes - bit)) != 0) {
            return formatError("payload: byte {}: spare bits are set", begin + bytes - 1);
        }
        return own - at_.blocks;
    }

    // Loads 8 bytes, which the padding allows.
    [[nodiscard]] uint64_t bitsAt(uint64_t begin, unsigned bit, unsigned width) const {
        const uint64_t bytes = loadLe<uint64_t>(payload_ + begin + bit / 8) >> (bit % 8);
        return bytes & ((uint64_t{1} << width) - 1);
    }

    // Where the leaf at `place` ends; all of it must lie before `end`.
    Result<uint64_t> leafEnd(uint64_t place, uint64_t end) const {
        const auto short_ = [&] { return formatError("payload: byte {}: leaf is cut short", place); };
        uint64_t codes = place + 1;
        uint32_t mixed = 0;
        const unsigned first = payload_[place];
        if (first >= shortCodes && ++codes > end) return short_();
        if (first == escape) {
            const unsigned kind = payload_[place + 1];
            if (kind == rawLeaf) {
                const uint64_t rawEnd = codes + 16 * patternBytes(set_.format);
                if (rawEnd > end) return short_();
                return rawEnd;
            }
            if (kind != explicitHead) {
                return formatError("payload: byte {}: kind of leaf {}, expected 0 or 1", place, kind);
            }
            codes += 4;
            if (codes > end) return short_();
            const auto head = loadLe<uint32_t>(payload_ + codes - 4);
            if ((head & (head >> 16)) != 0) {
                return formatError("payload: byte {}: a child is both mixed and opaque", place);
            }
            mixed = head & 0xffff;
        } else {
            const uint32_t code =
                first < shortCodes ? first : shortCodes + ((first - shortCodes) << 8 | payload_[place + 1]);
            if (code >= head_.heads) {
                return formatError("payload: byte {}: head {}, expected below {}", place, code, head_.heads);
            }
            mixed = loadLe<uint16_t>(payload_ + at_.heads + uint64_t{4} * code);
        }
        return codesEnd(codes, static_cast<unsigned>(std::popcount(mixed)), end);
    }

    Result<uint64_t> codesEnd(uint64_t codes, unsigned count, uint64_t end) const {
        uint64_t seconds = codes + count;
        unsigned escaped = 0;
        if (seconds > end) return formatError("payload: byte {}: leaf is cut short", codes);
        for (unsigned k = 0; k < count; ++k) {
            const unsigned first = payload_[codes + k];
            uint32_t code = first;
            if (first >= shortCodes) {
                if (seconds == end) return formatError("payload: byte {}: leaf is cut short", codes);
                code = shortCodes + ((first - shortCodes) << 8 | payload_[seconds++]);
            }
            if (first == escape) {
                ++escaped;
            } else if (code >= head_.patterns) {
                return formatError("payload: byte {}: pattern {}, expected below {}", codes + k, code,
                                   head_.patterns);
            }
        }
        const uint64_t rest = seconds + uint64_t{escaped} * (patternBytes(set_.format) - 1);
        if (rest > end) return formatError("payload: byte {}: leaf is cut short", codes);
        return rest;
    }

    Status checkMaps() {
        const unsigned width = head_.descriptorBits();
        uint64_t flat = 0;
        uint32_t used = 0;
        for (uint32_t map = 0; map < set_.mapCount; ++map) {
            const uint64_t bit = uint64_t{map} * width;
            const uint64_t fields =
                loadLe<uint64_t>(set_.descriptors.data() + Head::bytes + bit / 8) >> (bit % 8);
            if (auto status = checkMap(map, fields, flat, used); !status) return status;
        }
        if (used != head_.levels) {
            return formatError("descriptors: byte 4: levels {:#x}, the maps have {:#x}", head_.levels, used);
        }
        if (flat != head_.flat_bytes) {
            return formatError("descriptors: byte 40: {} bytes of flat maps, expected {}", head_.flat_bytes,
                               flat);
        }
        const uint64_t end = Head::bytes + uint64_t{width} * set_.mapCount / 8;
        const unsigned spare = static_cast<unsigned>(uint64_t{width} * set_.mapCount % 8);
        if (spare != 0 && (set_.descriptors[end] >> spare) != 0) {
            return formatError("descriptors: byte {}: spare bits are set", end);
        }
        return checkZero(set_.descriptors.last(descriptorPadding), "descriptors",
                         set_.descriptors.size() - descriptorPadding);
    }

    Status checkMap(uint32_t map, uint64_t fields, uint64_t& flat, uint32_t& used) const {
        const auto take = [&](unsigned bits) {
            const uint64_t field = fields & ((uint64_t{1} << bits) - 1);
            fields >>= bits;
            return static_cast<uint32_t>(field);
        };
        const std::optional<unsigned> level = levelNumbered(take(head_.levelBits()));
        if (!level) return formatError("descriptors: map {}: no such level", map);
        used |= 1u << *level;
        const bool isFlat = head_.flat_maps != 0 && take(1) != 0;
        const uint32_t symmetry = take(symmetryBits);
        const uint32_t value = take(head_.value_bits);
        if (symmetry >= (isFlat ? 1 : micromap::symmetryCount)) {
            return formatError("descriptors: map {}: symmetry {}", map, symmetry);
        }
        if (isFlat) return checkFlat(map, *level, value, flat);
        const bool found = *level <= leafHeight ? value < isShared_.size() && isShared_[value]
                                                : value < head_.nodes[heightSlot(rootHeight(*level))];
        if (found) return {};
        return formatError("descriptors: map {}: no root {}", map, value);
    }

    [[nodiscard]] std::optional<unsigned> levelNumbered(unsigned number) const {
        for (unsigned level = 0; level <= micromap::maxLevel; ++level) {
            if (((head_.levels >> level) & 1) != 0 && number-- == 0) return level;
        }
        return std::nullopt;
    }

    Status checkFlat(uint32_t map, unsigned level, uint32_t value, uint64_t& flat) const {
        const uint64_t bytes = micromap::flatBytes(level, set_.format);
        if (value != flat || bytes > head_.flat_bytes - flat) {
            return formatError("descriptors: map {}: flat at {}, expected at {} of {}", map, value, flat,
                               head_.flat_bytes);
        }
        const uint64_t states = micromap::microTriangleCount(level) * micromap::bitsPerState(set_.format);
        if (states % 8 != 0 && (payload_[at_.flat + flat + states / 8] >> (states % 8)) != 0) {
            return formatError("payload: byte {}: spare bits of map {} are set", at_.flat + flat + states / 8,
                               map);
        }
        flat += bytes;
        return {};
    }

    const EncodedView& set_;
    const Head& head_;
    const Offsets& at_;
    const uint8_t* payload_;
    std::vector<bool> isShared_;  // by address: a shared leaf begins here
    std::vector<Block> blocks_;
    uint64_t referenceBytes_ = 0;
};

}  // namespace

Result<SdagReader> SdagReader::open(const EncodedView& set) {
    if (set.descriptors.size() < Head::bytes) {
        return formatError("descriptors: {} bytes, expected at least {}", set.descriptors.size(),
                           Head::bytes);
    }
    const Head head = readHead(set.descriptors);
    if (auto checked = checkHead(head, set); !checked) return checked.error();
    const Offsets at = offsetsOf(head, set.format);
    if (auto checked = checkSizes(head, at, set); !checked) return checked.error();
    Checker checker(set, head, at);
    if (auto checked = checker.run(); !checked) return checked.error();
    return SdagReader(set, openedAs<filigree_sdag>(filigree_sdag_open, set), checker.referenceBytes());
}

}  // namespace filigree::encoding
