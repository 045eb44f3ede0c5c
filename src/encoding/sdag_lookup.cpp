#include "filigree/encoding/sdag.h"
#include "filigree/micromap/curve_batch.h"

#include <algorithm>
#include <array>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoding/sdag_lookup.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef FILIGREE_ENCODING_SDAG_LOOKUP
#define FILIGREE_ENCODING_SDAG_LOOKUP
namespace filigree::encoding {

// What the kernels read.
struct SdagBytes {
    const filigree_sdag& layout;
    const uint8_t* descriptors;
    const uint8_t* payload;
    unsigned patternShift;  // log2 of a pattern's bytes
};

// Left to the scalar code: maps that are stored flat.
constexpr uint32_t leftOver = 4;

}  // namespace filigree::encoding
#endif

HWY_BEFORE_NAMESPACE();
namespace filigree::encoding::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<uint32_t, 16>;
using LaneVector = hn::VFromD<Lanes>;
using LaneMask = decltype(hn::Eq(hn::Zero(Lanes()), hn::Zero(Lanes())));

inline LaneVector lowBits(LaneVector values, unsigned count) {
    return hn::And(values, hn::Set(Lanes(), static_cast<uint32_t>((uint64_t{1} << count) - 1)));
}
inline LaneMask bitAt(LaneVector bits, LaneVector place) {
    return hn::Ne(lowBits(hn::Shr(bits, place), 1), hn::Zero(Lanes()));
}
// How many bits of `bits` lie below `place`.
inline LaneVector rankBelow(LaneVector bits, LaneVector place) {
    const auto one = hn::Set(Lanes(), 1);
    return hn::PopulationCount(hn::And(bits, hn::Sub(hn::Shl(one, place), one)));
}
// The 4 bytes at base + offsets[lane], at any address.
inline LaneVector gatherBytes(const uint8_t* base, LaneVector offsets) {
    const hn::RebindToSigned<Lanes> signedLanes;
    return hn::GatherOffset(Lanes(), reinterpret_cast<const uint32_t*>(base),
                            hn::BitCast(signedLanes, offsets));
}

// One vector of lookups on its way down.
class Descent {
  public:
    Descent(const SdagBytes& bytes, LaneVector map, LaneVector a, LaneVector b) : bytes_(bytes) {
        const filigree_sdag& layout = bytes.layout;
        const auto bit = hn::Mul(map, set(layout.descriptor_bits));
        auto fields = hn::Shr(gatherBytes(bytes.descriptors, hn::ShiftRight<3>(bit)), lowBits(bit, 3));
        const auto take = [&](unsigned count) {
            const auto field = lowBits(fields, count);
            fields = hn::Shr(fields, set(count));
            return field;
        };
        // Most sets have one level.
        level_ = set(layout.levels[0]);
        if (layout.level_bits > 0) {
            level_ = lowBits(gatherBytes(layout.levels, take(layout.level_bits)), 8);
        }
        const auto flat = take(layout.flat_bit);
        turn(take(3), a, b);
        number_ = take(layout.value_bits);
        found_ = hn::IfThenElseZero(hn::Ne(flat, set(0)), set(leftOver));
        open_ = hn::Eq(flat, set(0));
    }

    // The state, or leftOver, of each lane.
    LaneVector run() {
        for (unsigned height = 12; height > 4; height -= 2) node(height);
        const auto isLeaf = hn::And(open_, hn::Gt(set(5), level_));
        leaf_ = hn::IfThenElse(isLeaf, hn::Add(number_, place(bytes_.layout.at.shared)), leaf_);
        if (!hn::AllFalse(d_, open_)) leaf();
        return found_;
    }

  private:
    [[nodiscard]] LaneVector set(uint32_t value) const { return hn::Set(d_, value); }
    // An offset into the payload, which is known to be small enough.
    [[nodiscard]] LaneVector place(uint64_t offset) const { return set(static_cast<uint32_t>(offset)); }
    [[nodiscard]] LaneVector gather(LaneMask lanes, LaneVector offsets) const {
        return gatherBytes(bytes_.payload, hn::IfThenElseZero(lanes, offsets));
    }

    void turn(LaneVector symmetry, LaneVector a, LaneVector b) {
        const auto matrix = hn::Shr(set(micromap::symmetryMatrices), hn::ShiftLeft<2>(symmetry));
        const auto pick = [&](unsigned bit, LaneVector plane) {
            return hn::IfThenElseZero(bitAt(matrix, set(bit)), plane);
        };
        a_ = hn::Xor(pick(0, a), pick(1, b));
        b_ = hn::Xor(pick(2, a), pick(3, b));
    }

    [[nodiscard]] LaneVector grandchildAt(unsigned low) const {
        const auto shift = set(low);
        return hn::Or(hn::ShiftLeft<2>(lowBits(hn::Shr(a_, shift), 2)), lowBits(hn::Shr(b_, shift), 2));
    }

    // Lanes of `on` whose child is not mixed are done. `head`: mixed in its low half, opaque in its high one.
    void settle(LaneMask on, LaneVector head, LaneVector child) {
        const auto done = hn::AndNot(bitAt(head, child), on);
        found_ = hn::IfThenElse(done, lowBits(hn::Shr(head, hn::Add(child, set(16))), 1), found_);
        open_ = hn::AndNot(done, open_);
    }

    void node(unsigned height) {
        const filigree_sdag& layout = bytes_.layout;
        const auto on = hn::And(open_, hn::Gt(level_, set(height - 2)));
        if (hn::AllFalse(d_, on)) return;
        const auto at =
            hn::Add(hn::Mul(number_, set(layout.node_bytes)), place(layout.at.nodes[height / 2 - 3]));
        const auto head = gather(on, at);
        const auto child = grandchildAt(height - 2);
        settle(on, head, child);
        const auto below = hn::And(on, open_);
        if (hn::AllFalse(d_, below)) return;
        const auto base = lowBits(gather(below, hn::Add(at, set(4))), 8 * (layout.node_bytes - 4));
        if (height > 6) {
            number_ = hn::IfThenElse(below, hn::Add(base, rankBelow(lowBits(head, 16), child)), number_);
        } else {
            leaf_ = hn::IfThenElse(below, leafUnder(below, head, base, child), leaf_);
        }
    }

    [[nodiscard]] LaneVector leafUnder(LaneMask lanes, LaneVector head, LaneVector base,
                                       LaneVector child) const {
        const filigree_sdag& layout = bytes_.layout;
        const auto mixed = lowBits(head, 16);
        const auto shared = hn::And(mixed, hn::ShiftRight<16>(head));
        const auto own = hn::AndNot(shared, mixed);
        const auto bit = hn::Add(hn::ShiftLeft<3>(rankBelow(own, child)),
                                 hn::Mul(rankBelow(shared, child), set(layout.reference_bits)));
        const auto block = hn::Add(base, place(layout.at.blocks));
        const auto loaded = gather(lanes, hn::Add(block, hn::ShiftRight<3>(bit)));
        const auto reference = hn::Shr(loaded, lowBits(bit, 3));
        return hn::IfThenElse(bitAt(shared, child),
                              hn::Add(place(layout.at.shared), lowBits(reference, layout.reference_bits)),
                              hn::Add(block, lowBits(reference, 8)));
    }

    void leaf() {
        const auto start = gather(open_, leaf_);
        const auto first = lowBits(start, 8);
        const auto second = lowBits(hn::ShiftRight<8>(start), 8);
        const auto isLong = hn::Gt(first, set(shortCodes - 1));
        const auto isEscaped = hn::And(open_, hn::Eq(first, set(escape)));
        const auto isRaw = hn::And(isEscaped, hn::Eq(second, set(1)));
        const auto inTable = hn::AndNot(isEscaped, open_);
        const auto code = hn::ShiftLeft<2>(longCode(isLong, first, second));
        auto head = gather(inTable, hn::Add(place(bytes_.layout.at.heads), code));
        if (!hn::AllFalse(d_, isEscaped)) {
            const auto plain = gather(isEscaped, hn::Add(leaf_, set(2)));
            head = hn::IfThenElse(isEscaped, hn::IfThenElse(isRaw, set(0xffff), plain), head);
        }
        const auto child = grandchildAt(2);
        settle(open_, head, child);
        if (hn::AllFalse(d_, open_)) return;
        const auto headBytes = hn::IfThenElse(isEscaped, set(6), hn::IfThenElse(isLong, set(2), set(1)));
        const auto pattern =
            codedPattern(hn::AndNot(isRaw, open_), hn::Add(leaf_, headBytes), lowBits(head, 16), child);
        settlePattern(rawPattern(hn::And(open_, isRaw), child, pattern));
    }

    // `pattern`, but of the raw leaves their own.
    [[nodiscard]] LaneVector rawPattern(LaneMask isRaw, LaneVector child, LaneVector pattern) const {
        if (hn::AllFalse(d_, isRaw)) return pattern;
        const auto at = hn::Add(hn::Add(leaf_, set(2)), hn::Shl(child, set(bytes_.patternShift)));
        return hn::IfThenElse(isRaw, gather(isRaw, at), pattern);
    }

    // The patterns under the codes of `lanes`; bits above a pattern are any.
    [[nodiscard]] LaneVector codedPattern(LaneMask lanes, LaneVector codes, LaneVector mixed,
                                          LaneVector child) const {
        const auto rank = rankBelow(mixed, child);
        const auto first = lowBits(gather(lanes, hn::Add(codes, rank)), 8);
        const auto isLong = hn::And(lanes, hn::Gt(first, set(shortCodes - 1)));
        if (hn::AllFalse(d_, isLong)) return tablePattern(lanes, first);
        const CodeBytes bytes(*this, isLong, codes);
        const auto count = hn::PopulationCount(mixed);
        const auto seconds = hn::Add(codes, count);
        const auto second = lowBits(gather(isLong, hn::Add(seconds, bytes.longBefore(rank))), 8);
        const auto isEscaped = hn::And(isLong, hn::Eq(first, set(escape)));
        const auto pattern = tablePattern(hn::AndNot(isEscaped, lanes), longCode(isLong, first, second));
        if (hn::AllFalse(d_, isEscaped)) return pattern;
        const auto rest = hn::Add(seconds, bytes.longBefore(count));
        const auto restBytes = set((1u << bytes_.patternShift) - 1);
        const auto at = hn::Add(rest, hn::Mul(restBytes, bytes.escapesBefore(rank)));
        const auto plain = hn::Or(hn::ShiftLeft<8>(gather(isEscaped, at)), second);
        return hn::IfThenElse(isEscaped, plain, pattern);
    }

    [[nodiscard]] LaneVector tablePattern(LaneMask lanes, LaneVector code) const {
        const auto at = hn::Shl(code, set(bytes_.patternShift));
        return gather(lanes, hn::Add(place(bytes_.layout.at.patterns), at));
    }

    // A state has as many bits as patternShift.
    void settlePattern(LaneVector pattern) {
        const auto at = hn::Shl(grandchildAt(0), set(bytes_.patternShift - 1));
        found_ = hn::IfThenElse(open_, lowBits(hn::Shr(pattern, at), bytes_.patternShift), found_);
    }

    [[nodiscard]] LaneVector longCode(LaneMask isLong, LaneVector first, LaneVector second) const {
        const auto limit = set(shortCodes);
        const auto code = hn::Add(limit, hn::Or(hn::ShiftLeft<8>(hn::Sub(first, limit)), second));
        return hn::IfThenElse(isLong, code, first);
    }

    // The first bytes of a leaf's codes, 16 of them in four words.
    class CodeBytes {
      public:
        CodeBytes(const Descent& descent, LaneMask lanes, LaneVector codes)
            : words_{descent.gather(lanes, codes), descent.gather(lanes, hn::Add(codes, descent.set(4))),
                     descent.gather(lanes, hn::Add(codes, descent.set(8))),
                     descent.gather(lanes, hn::Add(codes, descent.set(12)))} {}

        // How many of the first `count` <= 16 are at least shortCodes: their upper two bits are set.
        [[nodiscard]] LaneVector longBefore(LaneVector count) const {
            return marked(count, [](LaneVector word) { return hn::And(word, hn::ShiftLeft<1>(word)); });
        }
        // How many of the first `count` <= 16 are escapes: adding one to the lower seven bits carries.
        [[nodiscard]] LaneVector escapesBefore(LaneVector count) const {
            return marked(count, [](LaneVector word) {
                const auto lower = hn::And(word, hn::Set(Lanes(), 0x7f7f7f7f));
                return hn::And(word, hn::Add(lower, hn::Set(Lanes(), 0x01010101)));
            });
        }

      private:
        template <class Mark>
        [[nodiscard]] LaneVector marked(LaneVector count, const Mark& mark) const {
            const Lanes d;
            const auto four = hn::Set(d, 4);
            auto sum = hn::Zero(d);
            for (const auto& word : words_) {
                const auto inWord = hn::Min(count, four);
                const auto below =
                    hn::Sub(hn::Shl(hn::Set(d, 1), hn::ShiftLeft<3>(lowBits(inWord, 2))), hn::Set(d, 1));
                const auto all = hn::Set(d, 0xffffffff);
                const auto wanted = hn::IfThenElse(hn::Eq(inWord, four), all, below);
                const auto marks = hn::And(hn::And(mark(word), wanted), hn::Set(d, 0x80808080));
                sum = hn::Add(sum, hn::PopulationCount(marks));
                count = hn::Sub(count, inWord);
            }
            return sum;
        }

        LaneVector words_[4];
    };

    static constexpr uint32_t shortCodes = 192;
    static constexpr uint32_t escape = 255;

    const Lanes d_;
    const SdagBytes& bytes_;
    LaneVector level_;
    LaneVector a_;
    LaneVector b_;
    LaneVector number_;  // of the node, or the leaf's address at low levels
    LaneVector leaf_ = hn::Zero(Lanes());
    LaneVector found_;
    LaneMask open_;
};

// Results may be leftOver. `count` is a multiple of 16.
void lookupSdag(const SdagBytes& bytes, const uint32_t* maps, const uint32_t* a, const uint32_t* b,
                uint8_t* found, size_t count) {
    const Lanes d;
    const hn::Rebind<uint8_t, Lanes> narrow;
    for (size_t k = 0; k < count; k += hn::Lanes(d)) {
        Descent descent(bytes, hn::LoadU(d, maps + k), hn::LoadU(d, a + k), hn::LoadU(d, b + k));
        hn::StoreU(hn::TruncateTo(narrow, descent.run()), narrow, found + k);
    }
}

}  // namespace filigree::encoding::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::encoding {

HWY_EXPORT(lookupSdag);

namespace {

constexpr size_t chunk = 256;

}  // namespace

// 32-bit lanes hold all offsets, and each field with what stands before it in its byte.
bool SdagReader::fitsLanes() const {
    constexpr unsigned widest = 32 - 7;
    return set_.payload.size() < INT32_MAX && uint64_t{mapCount()} * view_.descriptor_bits < UINT32_MAX &&
           view_.descriptor_bits <= widest && view_.reference_bits <= widest;
}

// Some lookups at a time: planes, kernel, and the rare rest one by one. planesOfSome(first, levels, a, b)
// gives the planes of levels.size() of them.
template <class PlanesOfSome>
void SdagReader::lookupInChunks(std::span<const uint32_t> maps, std::span<micromap::State> states,
                                const PlanesOfSome& planesOfSome) const {
    std::array<uint32_t, chunk> some{};
    std::array<uint32_t, chunk> levels{};
    std::array<uint32_t, chunk> a{};
    std::array<uint32_t, chunk> b{};
    std::array<uint8_t, chunk> found;
    found.fill(leftOver);
    const bool inLanes = fitsLanes();
    const SdagBytes bytes{view_, view_.descriptors, view_.payload, view_.four_state != 0 ? 2u : 1u};
    for (size_t first = 0; first < maps.size(); first += chunk) {
        const size_t count = std::min(chunk, maps.size() - first);
        // Lanes behind the last lookup repeat its map.
        std::fill(std::copy_n(maps.begin() + static_cast<std::ptrdiff_t>(first), count, some.begin()),
                  some.end(), maps[first + count - 1]);
        if (view_.level_bits > 0 || first == 0) {
            for (size_t k = 0; k < count; ++k) levels[k] = level(some[k]);
        }
        planesOfSome(first, std::span(levels).first(count), std::span(a).first(count),
                     std::span(b).first(count));
        if (inLanes) {
            HWY_DYNAMIC_DISPATCH(lookupSdag)
            (bytes, some.data(), a.data(), b.data(), found.data(), (count + 15) / 16 * 16);
        }
        for (size_t k = 0; k < count; ++k) {
            states[first + k] = static_cast<micromap::State>(
                found[k] < leftOver ? found[k]
                                    : filigree_sdag_state_of_(
                                          &view_, filigree_sdag_descriptor_(&view_, some[k]), {a[k], b[k]}));
        }
    }
}

void SdagReader::lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                        std::span<micromap::State> states) const {
    assert(indices.size() == maps.size() && states.size() == maps.size());
    lookupInChunks(maps, states, [&](size_t first, auto levels, auto a, auto b) {
        for (size_t k = 0; k < levels.size(); ++k) {
            const auto planes = micromap::planesOfIndex(indices[first + k], levels[k]);
            a[k] = planes.a;
            b[k] = planes.b;
        }
    });
}

void SdagReader::lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                        std::span<micromap::State> states) const {
    assert(u.size() == maps.size() && v.size() == maps.size() && states.size() == maps.size());
    lookupInChunks(maps, states, [&](size_t first, auto levels, auto a, auto b) {
        micromap::barycentricsToPlanes(u.subspan(first, levels.size()), v.subspan(first, levels.size()),
                                       levels, a, b);
    });
}

}  // namespace filigree::encoding
#endif
