// The distinct nodes of a graph, in the order in which they first came.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding::dag {

class Nodes {
  public:
    // The number of the node of those words and height, which is added if it is new.
    uint32_t intern(unsigned height, std::span<const uint32_t> words);

    [[nodiscard]] size_t size() const { return entries_.size(); }
    [[nodiscard]] uint32_t start(size_t number) const { return entries_[number].start; }
    [[nodiscard]] unsigned height(size_t number) const { return entries_[number].tag & heightMask; }
    [[nodiscard]] std::span<const uint32_t> words(size_t number) const {
        const size_t end = number + 1 < size() ? entries_[number + 1].start : words_.size();
        return std::span(words_).subspan(entries_[number].start, end - entries_[number].start);
    }
    [[nodiscard]] std::span<const uint32_t> words() const { return words_; }

  private:
    static constexpr uint32_t heightMask = 15;
    struct Entry {
        uint32_t start = 0;  // word
        uint32_t tag = 0;    // high bits of the hash, and the height
    };
    void grow();

    std::vector<uint32_t> words_;
    std::vector<Entry> entries_;
    std::vector<uint32_t> slots_;  // number + 1 of a node, or 0; a power of two of them
};

}  // namespace filigree::encoding::dag
