#include "quadmap/vq4_book.h"

#include <algorithm>
#include <bit>

namespace filigree::quadmap {
namespace {

// What may be known where both vectors are kept right.
States4 commonOf(const Vector4& a, const Vector4& b) {
    return {static_cast<uint16_t>((a.transparent | a.free) & (b.transparent | b.free)),
            static_cast<uint16_t>((a.opaque | a.free) & (b.opaque | b.free))};
}

// A set of words in the order in which they came.
class WordSet {
  public:
    explicit WordSet(size_t most) : slots_(std::bit_ceil(2 * most + 2), 0) { words_.reserve(most); }

    void add(const States4& word) {
        if (word.empty()) return;
        const size_t mask = slots_.size() - 1;
        const uint32_t key = word.transparent | uint32_t{word.opaque} << 16;
        size_t at = (key * 0x9e3779b1U >> 7) & mask;
        for (; slots_[at] != 0; at = (at + 1) & mask) {
            if (words_[slots_[at] - 1] == word) return;
        }
        words_.push_back(word);
        slots_[at] = static_cast<uint32_t>(words_.size());
    }
    std::vector<States4> take() && { return std::move(words_); }

  private:
    std::vector<uint32_t> slots_;
    std::vector<States4> words_;
};

// Free regions of both states make a word that is both; then each reading counts.
void addReadings(States4 word, WordSet& set) {
    set.add({word.transparent, 0});
    set.add({0, word.opaque});
    const unsigned both = word.transparent & word.opaque;
    set.add(representable({word.transparent, static_cast<uint16_t>(word.opaque & ~both)}));
    if (both != 0) set.add(representable({static_cast<uint16_t>(word.transparent & ~both), word.opaque}));
}

std::vector<Vector4> distinct(std::span<const Vector4> vectors) {
    std::vector<Vector4> found;
    for (const Vector4& vector : vectors) {
        if (std::ranges::find(found, vector) == found.end()) found.push_back(vector);
    }
    return found;
}

}  // namespace

Candidates4::Candidates4(const VectorLanes& lanes, std::span<const Vector4> vectors, const Weights& weights) {
    const auto kinds = distinct(vectors);
    WordSet set(2 * kinds.size() * (kinds.size() + 1));
    for (size_t a = 0; a < kinds.size(); ++a) {
        for (size_t b = a; b < kinds.size(); ++b) addReadings(commonOf(kinds[a], kinds[b]), set);
    }
    words_ = std::move(set).take();
    sort(lanes, weights);
}

void Candidates4::sort(const VectorLanes& lanes, const Weights& weights) {
    rows_.resize(words_.size());
    sums_.resize(words_.size());
    gainsOf(lanes, words_, weights, rows_, sums_);
    std::vector<uint64_t> keys(words_.size());
    for (size_t k = 0; k < keys.size(); ++k) {
        const auto shape = static_cast<uint64_t>(shapeOf(words_[k]));
        ++starts_[shape + 1];
        keys[k] = shape << 48 | uint64_t{static_cast<uint16_t>(~sums_[k])} << 32 | k;
    }
    for (size_t s = 0; s < shapeCount; ++s) starts_[s + 1] += starts_[s];
    std::ranges::sort(keys);
    const auto words = std::move(words_);
    const auto rows = std::move(rows_);
    const auto sums = std::move(sums_);
    words_.clear();
    rows_.clear();
    sums_.clear();
    for (const uint64_t key : keys) {
        const auto k = static_cast<uint32_t>(key);
        words_.push_back(words[k]);
        rows_.push_back(rows[k]);
        sums_.push_back(sums[k]);
    }
}

BestRow Candidates4::best(unsigned shapes, const GainRow& rest, unsigned restSum, unsigned total) const {
    BestRow best{total, SIZE_MAX};
    for (size_t s = 0; s < shapeCount; ++s) {
        if ((shapes >> s & 1) == 0) continue;
        findBest(rows_, sums_, starts_[s], starts_[s + 1], rest, restSum, best);
    }
    return best;
}

BookSearch::BookSearch(const VectorLanes& lanes, Vq4Layout layout, const Weights& weights,
                       std::span<const States4> words)
    : lanes_(lanes), layout_(layout), weights_(weights) {
    assert(words.size() <= word4Count);
    std::ranges::copy(words, words_.begin());
    std::array<uint16_t, word4Count> sums{};
    gainsOf(lanes_, words_, weights_, rows_, sums);
    GainRow most;
    for (const GainRow& row : rows_) takeLarger(most, row);
    total_ = sumOf(most);
}

void BookSearch::improve(const Candidates4& candidates, unsigned passes) {
    bool better = true;
    for (unsigned pass = 0; pass < passes && better; ++pass) {
        better = false;
        for (unsigned slot = 0; slot < word4Count; ++slot) better |= improveSlot(slot, candidates);
    }
}

bool BookSearch::improveSlot(unsigned slot, const Candidates4& candidates) {
    unsigned shapes = 0;
    for (unsigned s = 0; s < shapeCount; ++s) {
        ShapeCounts counts = shapesWithout(slot);
        ++counts[s];
        if (fits(counts, layout_)) shapes |= 1U << s;
    }
    const GainRow rest = restWithout(slot);
    const BestRow best = candidates.best(shapes, rest, sumOf(rest), total_);
    if (best.row == SIZE_MAX) return false;
    words_[slot] = candidates.word(best.row);
    rows_[slot] = candidates.row(best.row);
    total_ = best.total;
    return true;
}

GainRow BookSearch::restWithout(unsigned slot) const {
    GainRow rest;
    for (unsigned k = 0; k < word4Count; ++k) {
        if (k != slot) takeLarger(rest, rows_[k]);
    }
    return rest;
}

ShapeCounts BookSearch::shapesWithout(unsigned slot) const {
    ShapeCounts counts{};
    for (unsigned k = 0; k < word4Count; ++k) {
        if (k != slot && !words_[k].empty()) ++counts[static_cast<size_t>(shapeOf(words_[k]))];
    }
    return counts;
}

States4 BookSearch::common(unsigned slot, std::span<const Vector4> vectors, const GainRow& most) const {
    States4 common{0xffff, 0xffff};
    bool used = false;
    for (size_t v = 0; v < vectors.size(); ++v) {
        if (most.gains[v] == 0 || rows_[slot].gains[v] != most.gains[v]) continue;
        used = true;
        const States4 own = commonOf(vectors[v], vectors[v]);
        common.transparent &= own.transparent;
        common.opaque &= own.opaque;
    }
    if (!used) return words_[slot];
    // Where both would do, what the word has stays.
    const States4& word = words_[slot];
    common.opaque = static_cast<uint16_t>(common.opaque & ~(word.transparent & common.opaque));
    common.transparent = static_cast<uint16_t>(common.transparent & ~common.opaque);
    return representable(common);
}

bool BookSearch::refit(std::span<const Vector4> vectors) {
    bool grew = false;
    GainRow most;
    for (const GainRow& row : rows_) takeLarger(most, row);
    for (unsigned slot = 0; slot < word4Count; ++slot) {
        const States4 word = common(slot, vectors, most);
        if (word == words_[slot]) continue;
        ShapeCounts counts = shapesWithout(slot);
        ++counts[static_cast<size_t>(shapeOf(word))];
        if (!fits(counts, layout_)) continue;
        GainRow row;
        gainsOf(lanes_, word, weights_, row);
        GainRow all = restWithout(slot);
        takeLarger(all, row);
        const unsigned total = sumOf(all);
        if (total <= total_) continue;
        words_[slot] = word;
        rows_[slot] = row;
        total_ = total;
        most = all;
        grew = true;
    }
    return grew;
}

std::vector<States4> BookSearch::words() const {
    std::vector<States4> words;
    for (const States4& word : words_) {
        if (!word.empty()) words.push_back(word);
    }
    return words;
}

std::vector<States4> fitted(std::vector<States4> words, const VectorLanes& lanes, Vq4Layout layout,
                            const Weights& weights) {
    assert(words.size() <= word4Count);
    const auto countsOf = [](const std::vector<States4>& some) {
        ShapeCounts counts{};
        for (const States4& word : some) ++counts[static_cast<size_t>(shapeOf(word))];
        return counts;
    };
    while (!fits(countsOf(words), layout)) {
        std::vector<States4> best;
        int most = -1;
        for (size_t k = 0; k < words.size(); ++k) {
            for (const Word4Kind kind : {Word4Kind::simple, Word4Kind::vertical, Word4Kind::horizontal}) {
                auto changed = words;
                changed[k] = reduced(words[k], kind);
                if (changed[k] == words[k]) continue;
                const auto total = static_cast<int>(bookGain(lanes, changed, weights));
                if (total <= most) continue;
                most = total;
                best = std::move(changed);
            }
        }
        words = std::move(best);
    }
    return words;
}

}  // namespace filigree::quadmap
