// Codebooks for given vectors: candidates and the swap search.
#pragma once

#include "quadmap/vq4_gains.h"

#include <array>
#include <span>
#include <vector>

namespace filigree::quadmap {

// Words that a book may consist of: what two vectors have in common, and its transparent and its opaque part.
class Candidates4 {
  public:
    // The candidates for `lanes`, of which `vectors` are the vectors.
    Candidates4(const VectorLanes& lanes, std::span<const Vector4> vectors, const Weights& weights);

    [[nodiscard]] const States4& word(size_t k) const { return words_[k]; }
    [[nodiscard]] const GainRow& row(size_t k) const { return rows_[k]; }

    // The word of an allowed shape (bit s: shape s) that adds most to `rest`, if it makes more than `total`.
    [[nodiscard]] BestRow best(unsigned shapes, const GainRow& rest, unsigned restSum, unsigned total) const;

  private:
    void sort(const VectorLanes& lanes, const Weights& weights);

    std::vector<States4> words_;  // by shape, then by falling sum
    std::vector<GainRow> rows_;
    std::vector<uint16_t> sums_;
    std::array<size_t, shapeCount + 1> starts_{};
};

// A book with what its words gain in lanes.
class BookSearch {
  public:
    BookSearch(const VectorLanes& lanes, Vq4Layout layout, const Weights& weights,
               std::span<const States4> words);

    // Replaces words, and fills empty places, while that gains; at most `passes` times round.
    void improve(const Candidates4& candidates, unsigned passes);
    // Grows each word to all that its vectors have in common. True if one grew.
    bool refit(std::span<const Vector4> vectors);

    [[nodiscard]] unsigned total() const { return total_; }
    [[nodiscard]] std::vector<States4> words() const;

  private:
    bool improveSlot(unsigned slot, const Candidates4& candidates);
    [[nodiscard]] GainRow restWithout(unsigned slot) const;
    [[nodiscard]] ShapeCounts shapesWithout(unsigned slot) const;
    [[nodiscard]] States4 common(unsigned slot, std::span<const Vector4> vectors, const GainRow& most) const;

    const VectorLanes& lanes_;
    Vq4Layout layout_;
    Weights weights_;
    std::array<States4, word4Count> words_{};
    std::array<GainRow, word4Count> rows_{};
    unsigned total_ = 0;
};

// A book of at most `word4Count` words that fits the layout, made of words that may not: each time the change
// of one word that loses least.
std::vector<States4> fitted(std::vector<States4> words, const VectorLanes& lanes, Vq4Layout layout,
                            const Weights& weights);

}  // namespace filigree::quadmap
