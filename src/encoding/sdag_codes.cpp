#include "encoding/sdag_codes.h"

#include <algorithm>
#include <numeric>

namespace filigree::encoding::sdag {
namespace {

uint64_t hashOf(uint32_t value) {
    uint64_t hash = (value + uint64_t{1}) * 0x9fb21c651e98df25u;
    hash ^= hash >> 32;
    return hash * 0x9fb21c651e98df25u >> 8;
}

struct Count {
    uint32_t value = 0;
    uint32_t uses = 0;
};

std::vector<Count> countUses(std::span<const uint32_t> values) {
    std::vector<Count> counts;
    HashTable table;
    for (const uint32_t value : values) {
        const auto next = static_cast<uint32_t>(counts.size());
        const uint32_t at =
            table.findOrAdd(hashOf(value), next, [&](uint32_t k) { return counts[k].value == value; });
        if (at == next) counts.push_back({value, 0});
        ++counts[at].uses;
    }
    return counts;
}

uint32_t headOf(const Leaf& leaf) {
    return leaf.mixed() | (uint32_t{leaf.opaque()} << 16);
}

std::vector<uint32_t> headsOf(std::span<const Leaf> leaves) {
    std::vector<uint32_t> heads;
    heads.reserve(leaves.size());
    for (const Leaf& leaf : leaves) heads.push_back(headOf(leaf));
    return heads;
}

template <class Body>
void forMixed(const Leaf& leaf, Body body) {
    for (const Pattern pattern : leaf.patterns) {
        if (!isKnownUniform(pattern)) body(pattern);
    }
}

std::vector<uint32_t> patternsOf(std::span<const Leaf> leaves) {
    std::vector<uint32_t> patterns;
    for (const Leaf& leaf : leaves) {
        forMixed(leaf, [&](Pattern pattern) { patterns.push_back(pattern); });
    }
    return patterns;
}

void appendLe(std::vector<uint8_t>& to, uint32_t value, unsigned bytes) {
    for (unsigned k = 0; k < bytes; ++k) to.push_back(static_cast<uint8_t>(value >> (8 * k)));
}

constexpr unsigned explicitHeadBytes = 6;

}  // namespace

Dictionary::Dictionary(std::span<const uint32_t> uses, unsigned entryBytes, unsigned plainBytes) {
    std::vector<Count> counts = countUses(uses);
    std::ranges::sort(counts, [](const Count& a, const Count& b) {
        return a.uses != b.uses ? a.uses > b.uses : a.value < b.value;
    });
    for (const Count& count : counts) {
        const auto code = static_cast<uint32_t>(values_.size());
        if (code == codeLimit || count.uses * (plainBytes - codeBytes(code)) <= entryBytes) break;
        codes_.add(hashOf(count.value), code);
        values_.push_back(count.value);
    }
}

uint32_t Dictionary::codeOf(uint32_t value) const {
    return codes_.find(hashOf(value), [&](uint32_t code) { return values_[code] == value; });
}

LeafCoder::LeafCoder(std::span<const Leaf> leaves, micromap::Format format)
    : patternBytes_(patternBytes(format)),
      twoState_(format == micromap::Format::twoState),
      patterns_(patternsOf(leaves), patternBytes_, 1 + patternBytes_),
      heads_(headsOf(leaves), 4, explicitHeadBytes) {}

unsigned LeafCoder::codedBytes(const Leaf& leaf) const {
    const uint32_t head = heads_.codeOf(headOf(leaf));
    unsigned bytes = head == HashTable::none ? explicitHeadBytes : codeBytes(head);
    forMixed(leaf, [&](Pattern pattern) {
        const uint32_t code = patterns_.codeOf(pattern);
        bytes += code == HashTable::none ? 1 + patternBytes_ : codeBytes(code);
    });
    return bytes;
}

unsigned LeafCoder::bytes(const Leaf& leaf) const {
    return std::min(codedBytes(leaf), rawBytes());
}

void LeafCoder::append(const Leaf& leaf, std::vector<uint8_t>& to) const {
    if (codedBytes(leaf) > rawBytes()) {
        appendRaw(leaf, to);
    } else {
        appendHead(leaf, to);
        appendPatterns(leaf, to);
    }
}

void LeafCoder::appendHead(const Leaf& leaf, std::vector<uint8_t>& to) const {
    const uint32_t head = headOf(leaf);
    const uint32_t code = heads_.codeOf(head);
    if (code == HashTable::none) {
        to.push_back(escape);
        to.push_back(explicitHead);
        appendLe(to, head, 4);
    } else {
        to.push_back(static_cast<uint8_t>(firstByte(code)));
        if (codeBytes(code) == 2) to.push_back(static_cast<uint8_t>(secondByte(code)));
    }
}

// First bytes, then second bytes, then what else uncoded patterns have.
void LeafCoder::appendPatterns(const Leaf& leaf, std::vector<uint8_t>& to) const {
    std::vector<uint8_t> seconds;
    std::vector<uint8_t> rest;
    forMixed(leaf, [&](Pattern pattern) {
        const uint32_t code = patterns_.codeOf(pattern);
        if (code == HashTable::none) {
            const uint32_t plain = packed(pattern, twoState_);
            to.push_back(escape);
            seconds.push_back(static_cast<uint8_t>(plain));
            appendLe(rest, plain >> 8, patternBytes_ - 1);
        } else {
            to.push_back(static_cast<uint8_t>(firstByte(code)));
            if (codeBytes(code) == 2) seconds.push_back(static_cast<uint8_t>(secondByte(code)));
        }
    });
    to.insert(to.end(), seconds.begin(), seconds.end());
    to.insert(to.end(), rest.begin(), rest.end());
}

void LeafCoder::appendRaw(const Leaf& leaf, std::vector<uint8_t>& to) const {
    to.push_back(escape);
    to.push_back(rawLeaf);
    for (const Pattern pattern : leaf.patterns) appendLe(to, packed(pattern, twoState_), patternBytes_);
}

uint32_t packed(Pattern pattern, bool twoState) {
    return twoState ? filigree_gather_(pattern) : pattern;
}

}  // namespace filigree::encoding::sdag
