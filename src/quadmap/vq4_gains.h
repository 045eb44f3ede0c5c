// What words are worth to many 4 x 4 vectors at once.
#pragma once

#include "quadmap/vq4_words.h"

#include <array>
#include <cstdint>
#include <span>

namespace filigree::quadmap {

inline constexpr unsigned lanes4 = 64;  // more vectors than a square has

// Up to 64 vectors, side by side.
struct VectorLanes {
    alignas(64) std::array<uint16_t, lanes4> transparent{};
    alignas(64) std::array<uint16_t, lanes4> opaque{};
    alignas(64) std::array<uint16_t, lanes4> notTransparent{};  // where a transparent word would be wrong
    alignas(64) std::array<uint16_t, lanes4> notOpaque{};
    unsigned count = 0;

    void add(const Vector4& vector) {
        transparent[count] = vector.transparent;
        opaque[count] = vector.opaque;
        notTransparent[count] = static_cast<uint16_t>(~(vector.transparent | vector.free));
        notOpaque[count] = static_cast<uint16_t>(~(vector.opaque | vector.free));
        ++count;
    }
};

// The gain of each vector; 0 in unused lanes.
struct alignas(64) GainRow {
    std::array<uint8_t, lanes4> gains{};
};

// The gains of one word in all lanes, and their sum.
unsigned gainsOf(const VectorLanes& lanes, const States4& word, const Weights& weights, GainRow& row);

// The gains of many words: rows[k] and sums[k] of words[k].
void gainsOf(const VectorLanes& lanes, std::span<const States4> words, const Weights& weights,
             std::span<GainRow> rows, std::span<uint16_t> sums);

// Per lane the larger gain, and the sum over lanes.
void takeLarger(GainRow& row, const GainRow& other);
unsigned sumOf(const GainRow& row);

// A row that adds most to another.
struct BestRow {
    unsigned total = 0;
    size_t row = SIZE_MAX;
};
// Betters `best` with the rows first..last - 1: the sum of the larger gains of the row and `rest`. `sums` are
// those of the rows, falling; of equals the first stays.
void findBest(std::span<const GainRow> rows, std::span<const uint16_t> sums, size_t first, size_t last,
              const GainRow& rest, unsigned restSum, BestRow& best);

// What `lanes` gain from a whole book.
unsigned bookGain(const VectorLanes& lanes, std::span<const States4> words, const Weights& weights);

}  // namespace filigree::quadmap
