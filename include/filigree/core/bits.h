// Bit strings, least significant bit first in each byte, as all formats of the project store them.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree {

// Grows a bit string in 64-bit words.
class BitWriter {
  public:
    // Appends the low `count` bits of `bits`, 0 <= count <= 64; higher bits are ignored.
    void append(uint64_t bits, unsigned count) {
        assert(count <= 64);
        if (count == 0) return;
        if (count < 64) bits &= (uint64_t{1} << count) - 1;
        const unsigned used = static_cast<unsigned>(size_ & 63);
        if (used == 0) {
            words_.push_back(bits);
        } else {
            words_.back() |= bits << used;
            if (used + count > 64) words_.push_back(bits >> (64 - used));
        }
        size_ += count;
    }

    // Appends all of `other`.
    void append(const BitWriter& other) {
        for (size_t at = 0; at < other.size_; at += 64) {
            append(other.words_[at / 64],
                   static_cast<unsigned>(other.size_ - at < 64 ? other.size_ - at : 64));
        }
    }

    // Takes back all bits from `size` on.
    void truncate(size_t size) {
        assert(size <= size_);
        size_ = size;
        words_.resize((size + 63) / 64);
        if (size % 64 != 0) words_.back() &= (uint64_t{1} << (size % 64)) - 1;
    }

    [[nodiscard]] size_t size() const { return size_; }  // in bits
    [[nodiscard]] std::span<const uint64_t> words() const { return words_; }
    std::vector<uint64_t> take() && { return std::move(words_); }
    void clear() {
        words_.clear();
        size_ = 0;
    }

  private:
    std::vector<uint64_t> words_;
    size_t size_ = 0;
};

// Reads a bit string from 64-bit words. Reading past `size` bits is misuse and asserts: check with left().
class BitReader {
  public:
    BitReader(std::span<const uint64_t> words, size_t size) : words_(words), size_(size) {
        assert(size <= words.size() * 64);
    }

    [[nodiscard]] size_t left() const { return size_ - at_; }
    [[nodiscard]] size_t position() const { return at_; }

    uint64_t take(unsigned count) {
        assert(count <= 64 && count <= left());
        if (count == 0) return 0;
        const unsigned used = static_cast<unsigned>(at_ & 63);
        uint64_t bits = words_[at_ / 64] >> used;
        if (used + count > 64) bits |= words_[at_ / 64 + 1] << (64 - used);
        at_ += count;
        return count < 64 ? bits & ((uint64_t{1} << count) - 1) : bits;
    }
    bool takeBit() { return take(1) != 0; }

  private:
    std::span<const uint64_t> words_;
    size_t size_;
    size_t at_ = 0;
};

}  // namespace filigree
