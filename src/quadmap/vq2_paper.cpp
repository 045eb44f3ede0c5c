// Algorithm 1 of Fenney and Ozkan 2023.
#include "quadmap/vq2_paper.h"

#include <algorithm>
#include <vector>

namespace filigree::quadmap {
namespace {

// A quadrant's vectors as numbers of words, noWord2 for uniform ones. The paper knows no free regions and no
// vectors of both states: where all fits a uniform word it is one, else the state with more regions counts.
std::array<uint8_t, 16> numbersOf(const Quadrant2& quadrant) {
    std::array<uint8_t, 16> numbers{};
    for (size_t v = 0; v < numbers.size(); ++v) {
        const Vector2& vector = quadrant[v];
        const bool opaque = std::popcount(vector.opaque) > std::popcount(vector.transparent);
        const unsigned known = opaque ? vector.opaque : vector.transparent;
        const bool uniform = known == 0 || (known | vector.free) == 15;
        numbers[v] = static_cast<uint8_t>(uniform ? noWord2 : (opaque ? 14 : 0) + known - 1);
    }
    return numbers;
}

// A word of the transformed square, with how often it occurs and in which quadrants (bits).
struct Candidate {
    unsigned number = 0;
    unsigned count = 0;
    unsigned quadrants = 0;
};

// By decreasing score; equal scores by the word's code. The paper takes from the end.
std::vector<Candidate> prioritised(const std::array<std::array<uint8_t, 16>, 4>& numbers,
                                   const std::array<Transform, 4>& transforms, bool literal) {
    std::array<Candidate, word2Count + 1> found{};
    for (unsigned q = 0; q < 4; ++q) {
        for (const uint8_t shown : numbers[q]) {
            Candidate& word = found[transformedWord2(inverse(transforms[q]), shown)];
            ++word.count;
            word.quadrants |= 1U << q;
        }
    }
    std::vector<Candidate> words;
    for (unsigned number = 0; number < word2Count; ++number) {
        found[number].number = number;
        if (found[number].count > 0) words.push_back(found[number]);
    }
    const auto score = [&](const Candidate& word) {
        const int known = std::popcount(word2Code(word.number) & 15U);
        return static_cast<int>(word.count) * (literal ? 4 - known : -known);
    };
    std::ranges::stable_sort(words,
                             [&](const Candidate& a, const Candidate& b) { return score(a) > score(b); });
    return words;
}

// Codebooks that fill up.
struct Book {
    std::vector<unsigned> shared;
    std::array<std::vector<unsigned>, 4> own;

    [[nodiscard]] bool sharedFull() const { return shared.size() == 3; }
    [[nodiscard]] bool ownFull(unsigned quadrant) const { return own[quadrant].size() == 2; }
    [[nodiscard]] bool full() const {
        return sharedFull() && ownFull(0) && ownFull(1) && ownFull(2) && ownFull(3);
    }

    void add(const Candidate& word) {
        if (std::has_single_bit(word.quadrants)) {
            addToOne(word.number, static_cast<unsigned>(std::countr_zero(word.quadrants)));
        } else if (!sharedFull()) {
            shared.push_back(word.number);
        } else {
            for (unsigned q = 0; q < 4; ++q) {
                if ((word.quadrants >> q & 1) != 0 && !ownFull(q)) own[q].push_back(word.number);
            }
        }
    }

  private:
    void addToOne(unsigned number, unsigned quadrant) {
        if (!ownFull(quadrant)) {
            own[quadrant].push_back(number);
        } else if (!sharedFull()) {
            shared.push_back(number);
        }
    }
};

Book bookOf(std::vector<Candidate> words) {
    Book book;
    while (!book.full() && !words.empty()) {
        book.add(words.back());
        words.pop_back();
    }
    return book;
}

unsigned totalOf(const Book& book, const std::array<Transform, 4>& transforms,
                 const std::array<QuadrantGains, 4>& gains) {
    unsigned total = 0;
    for (unsigned q = 0; q < 4; ++q) {
        Gains all = gains[q].transparent | gains[q].opaque;
        for (const unsigned word : book.shared)
            all = all | gains[q].words[transformedWord2(transforms[q], word)];
        for (const unsigned word : book.own[q])
            all = all | gains[q].words[transformedWord2(transforms[q], word)];
        total += all.total();
    }
    return total;
}

Vq2 mapOf(const Book& book, const std::array<Transform, 4>& transforms) {
    Vq2 map;
    map.transforms = transforms;
    for (size_t k = 0; k < book.shared.size(); ++k) map.shared[k] = word2Code(book.shared[k]);
    for (unsigned q = 0; q < 4; ++q) {
        for (size_t k = 0; k < book.own[q].size(); ++k) map.own[q][k] = word2Code(book.own[q][k]);
    }
    return map;
}

}  // namespace

Vq2 paperVq2(const std::array<Quadrant2, 4>& quadrants, bool literal) {
    std::array<std::array<uint8_t, 16>, 4> numbers{};
    std::array<QuadrantGains, 4> gains{};
    for (unsigned q = 0; q < 4; ++q) {
        numbers[q] = numbersOf(quadrants[q]);
        gains[q] = gainsOf(quadrants[q], {});
    }
    Vq2 best;
    int most = -1;
    for (unsigned combination = 0; combination < 512; ++combination) {
        const std::array<Transform, 4> transforms{0, static_cast<Transform>(combination >> 6),
                                                  static_cast<Transform>(combination >> 3 & 7),
                                                  static_cast<Transform>(combination & 7)};
        const Book book = bookOf(prioritised(numbers, transforms, literal));
        const int total = static_cast<int>(totalOf(book, transforms, gains));
        if (total <= most) continue;
        most = total;
        best = mapOf(book, transforms);
    }
    return best;
}

}  // namespace filigree::quadmap
