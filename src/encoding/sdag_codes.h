// Short codes for the patterns and heads that occur often, and the bytes of leaves in them.
#pragma once

#include "encoding/hash_table.h"
#include "encoding/sdag_leaf.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding::sdag {

// Values by falling frequency; a value's code is its place.
class Dictionary {
  public:
    // Keeps values as long as each saves more than the `entryBytes` that it costs, where without a code it
    // takes `plainBytes` at each use.
    Dictionary(std::span<const uint32_t> uses, unsigned entryBytes, unsigned plainBytes);

    [[nodiscard]] const std::vector<uint32_t>& values() const { return values_; }
    // HashTable::none for a value without.
    [[nodiscard]] uint32_t codeOf(uint32_t value) const;

  private:
    std::vector<uint32_t> values_;
    HashTable codes_;
};

// Writes leaves (docs/spec/sdag.md, "Leaves").
class LeafCoder {
  public:
    LeafCoder(std::span<const Leaf> leaves, micromap::Format format);

    [[nodiscard]] const Dictionary& patterns() const { return patterns_; }
    [[nodiscard]] const Dictionary& heads() const { return heads_; }

    // At most 2 + 16 patternBytes.
    [[nodiscard]] unsigned bytes(const Leaf& leaf) const;
    void append(const Leaf& leaf, std::vector<uint8_t>& to) const;

  private:
    [[nodiscard]] unsigned codedBytes(const Leaf& leaf) const;
    [[nodiscard]] unsigned rawBytes() const { return 2 + 16 * patternBytes_; }
    void appendHead(const Leaf& leaf, std::vector<uint8_t>& to) const;
    void appendPatterns(const Leaf& leaf, std::vector<uint8_t>& to) const;
    void appendRaw(const Leaf& leaf, std::vector<uint8_t>& to) const;

    unsigned patternBytes_;
    bool twoState_;
    Dictionary patterns_;
    Dictionary heads_;
};

// A pattern in patternBytes() low bytes, as tables and raw patterns store it.
uint32_t packed(Pattern pattern, bool twoState);

}  // namespace filigree::encoding::sdag
