// The plain decoder of docs/spec/sdag.md: a map as parts that are uniform, nodes, leaves, patterns or states.
#include "filigree/core/bytes.h"
#include "filigree/encoding/sdag.h"
#include "filigree/micromap/quadtree_writer.h"

#include "encoding/sdag_layout.h"

#include <cassert>

namespace filigree::encoding {

using micromap::State;

using namespace sdag;

// Steps from part to part with the reader's own pieces.
class SdagWalk {
  public:
    SdagWalk(const SdagReader& reader, uint32_t map)
        : reader_(reader),
          view_(&reader.view_),
          descriptor_(filigree_sdag_descriptor_(view_, map)),
          level_(filigree_sdag_level_of_(view_, descriptor_)) {
        for (unsigned digit = 0; digit < 4; ++digit) {
            digits_[digit] = static_cast<uint8_t>(
                micromap::turnedDigit(digit, filigree_sdag_symmetry_of_(view_, descriptor_)));
        }
    }

    [[nodiscard]] micromap::Quadtree decode() const {
        BitWriter stream;
        if (isFlat()) {
            const uint64_t bytes = micromap::flatBytes(level_, reader_.set_.format);
            const uint64_t at = view_->at.flat + filigree_sdag_value_of_(view_, descriptor_);
            return micromap::quadtreeFromFlat(reader_.set_.payload.subspan(at, bytes), level_,
                                              reader_.set_.format);
        }
        const Begin begin = top();
        if (begin.height == level_) {
            whole(begin.part, begin.height, false, stream);
        } else {
            half(begin.part, begin.height, 0, false, stream);
        }
        return {std::move(stream), level_};
    }

    [[nodiscard]] bool isFlat() const { return filigree_sdag_is_flat_(view_, descriptor_) != 0; }

    // How many micro-triangles of part `index` at `level` are on the opaque side, as a share.
    [[nodiscard]] double share(uint32_t index, unsigned level) const {
        const unsigned wanted = level_ - level;
        Begin at = top();
        // Digits of the part from the top, those of the padding included.
        const filigree_planes planes = filigree_planes_turned(filigree_planes_of_index(index, level),
                                                              filigree_sdag_symmetry_of_(view_, descriptor_));
        while (at.height >= wanted + 2) {
            const unsigned low = at.height - 2 - wanted;
            at = {child(at.part, at.height, filigree_sdag_grandchild_(planes, low)), at.height - 2};
        }
        if (at.height == wanted) return shareOf(at.part, at.height);
        double sum = 0;
        const unsigned upper = 2 * (planes.a & 1) + (planes.b & 1);
        for (unsigned lower = 0; lower < 4; ++lower) {
            sum += shareOf(child(at.part, at.height, grandchild(upper, lower)), at.height - 2);
        }
        return sum / 4;
    }

  private:
    // A part of a map at an even height, in the stored frame.
    struct MapPart {
        enum class Kind : uint8_t { uniform, node, leaf, pattern };
        Kind kind = Kind::uniform;
        uint32_t value = 0;              // the state, the node's number, or the pattern
        const uint8_t* bytes = nullptr;  // of a leaf
    };
    struct Begin {
        MapPart part;
        unsigned height = 0;
    };

    // The lowest part of even height that holds all of the map.
    [[nodiscard]] Begin top() const {
        const uint32_t value = filigree_sdag_value_of_(view_, descriptor_);
        Begin at;
        at.height = rootHeight(level_);
        if (at.height == leafHeight) {
            at.part = {MapPart::Kind::leaf, 0, view_->payload + view_->at.shared + value};
        } else {
            at.part = {MapPart::Kind::node, value, nullptr};
        }
        while (at.height >= level_ + 2) at = {child(at.part, at.height, 0), at.height - 2};
        return at;
    }

    [[nodiscard]] MapPart child(const MapPart& part, unsigned height, unsigned k) const {
        using Kind = MapPart::Kind;
        if (part.kind == Kind::uniform) return part;
        if (part.kind == Kind::pattern) {
            const unsigned bits = view_->four_state != 0 ? 2 : 1;
            return {Kind::uniform, (part.value >> (bits * k)) & ((1u << bits) - 1), nullptr};
        }
        if (part.kind == Kind::leaf) {
            const filigree_sdag_leaf head = filigree_sdag_leaf_(view_, part.bytes);
            if (((head.mixed >> k) & 1) == 0) return {Kind::uniform, (head.opaque >> k) & 1, nullptr};
            return {Kind::pattern, filigree_sdag_pattern_(view_, head, k), nullptr};
        }
        const filigree_sdag_node head = filigree_sdag_node_(view_, height, part.value);
        if (((head.mixed >> k) & 1) == 0) return {Kind::uniform, (head.opaque >> k) & 1, nullptr};
        if (height == leafHeight + 2) return {Kind::leaf, 0, filigree_sdag_leaf_under_(view_, head, k)};
        return {Kind::node, head.base + filigree_rank16(head.mixed, k), nullptr};
    }

    // Appends a part as a quadtree; `odd` as in digitOfChild.
    int whole(const MapPart& part, unsigned height, bool odd, BitWriter& to) const {
        if (part.kind == MapPart::Kind::uniform) {
            return micromap::appendLeaf(to, height, static_cast<int>(part.value));
        }
        return micromap::appendInner(to, height, [&](unsigned c) {
            return half(part, height, digits_[micromap::digitOfChild(c, odd)], odd != (c % 2 == 1), to);
        });
    }

    // Appends the quarter `upper` of a part of `height`.
    int half(const MapPart& part, unsigned height, unsigned upper, bool odd, BitWriter& to) const {
        return micromap::appendInner(to, height - 1, [&](unsigned c) {
            const unsigned lower = digits_[micromap::digitOfChild(c, odd)];
            return whole(child(part, height, grandchild(upper, lower)), height - 2, odd != (c % 2 == 1), to);
        });
    }

    [[nodiscard]] double shareOf(const MapPart& part, unsigned height) const {
        if (part.kind == MapPart::Kind::uniform) return part.value & 1;
        if (part.kind == MapPart::Kind::node && view_->has_shares != 0) {
            const uint64_t at = view_->at.shares[heightSlot(height)] + uint64_t{2} * part.value;
            return loadLe<uint16_t>(view_->payload + at) / 65535.0;
        }
        double sum = 0;
        for (unsigned k = 0; k < 16; ++k) sum += shareOf(child(part, height, k), height - 2);
        return sum / 16;
    }

    const SdagReader& reader_;
    const filigree_sdag* view_;
    uint64_t descriptor_;
    unsigned level_;
    std::array<uint8_t, 4> digits_{};  // the map's digits in the stored frame
};

micromap::Quadtree SdagReader::decode(uint32_t map) const {
    return SdagWalk(*this, map).decode();
}

float SdagReader::opaqueShare(uint32_t map, uint32_t index, unsigned level) const {
    assert(level <= this->level(map) && index < micromap::microTriangleCount(level));
    const SdagWalk walk(*this, map);
    if (!walk.isFlat()) return static_cast<float>(walk.share(index, level));
    const uint64_t count = micromap::microTriangleCount(this->level(map) - level);
    uint64_t opaque = 0;
    for (uint64_t k = index * count; k < (index + uint64_t{1}) * count; ++k) {
        opaque += micromap::isOpaqueSide(at(map, static_cast<uint32_t>(k))) ? 1 : 0;
    }
    return static_cast<float>(static_cast<double>(opaque) / static_cast<double>(count));
}

std::vector<Part> SdagReader::parts() const {
    const Offsets& at = view_.at;
    const uint64_t shareBytes = at.shared - at.shares[0];
    const uint64_t descriptorBits = uint64_t{view_.descriptor_bits} * mapCount();
    return {{"pattern table", 8 * (at.heads - at.patterns)},
            {"head table", 8 * (at.nodes[0] - at.heads)},
            {"nodes", 8 * (at.shared - at.nodes[0] - shareBytes)},
            {"shares", 8 * shareBytes},
            {"shared leaves", 8 * (at.blocks - at.shared)},
            {"references", 8 * referenceBytes_},
            {"own leaves", 8 * (at.padding - at.blocks - referenceBytes_)},
            {"flat maps", 8 * (set_.payload.size() - at.flat)},
            {"padding", 8 * (at.flat - at.padding + set_.descriptors.size() - Head::bytes) - descriptorBits},
            {"head", 8 * Head::bytes},
            {"descriptors", descriptorBits}};
}

}  // namespace filigree::encoding
