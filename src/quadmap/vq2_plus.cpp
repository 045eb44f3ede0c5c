// The optimum of VQ2+ over all transforms, codebooks and readings (docs/spec/vq2-plus.md).
#include "quadmap/vq2_best.h"
#include "quadmap/vq2_triples.h"

namespace filigree::quadmap {
namespace {

constexpr std::array<Transform, 2> rotations{1, 6};

// The shared words as stored: a triple, which of its words comes first, and how that is re-read.
struct Message {
    unsigned triple = 0;
    unsigned first = 0;     // 0..2, place in the triple
    unsigned rotation = 0;  // in `rotations`
};

// How a quadrant reads it.
struct Reading {
    unsigned total = 0;
    Transform transform = 0;
    bool rereads = false;
    bool opaqueIndex = false;  // index 2 re-reads, otherwise 0
};

// The codes' lowest bits, as stored, name the index: which bit that is once transformed.
unsigned messageBit(Transform transform) {
    return static_cast<unsigned>(std::countr_zero(transformedCells(transform, 2, 1)));
}

// A quadrant and what is known of it so far.
class PlusQuadrant {
  public:
    PlusQuadrant(const Quadrant2& vectors, const Weights& weights)
        : gains_(gainsOf(vectors, weights)), orbitBest_(Triples::all().orbitCount()) {
        totalsOfTriples(gains_, totals_);
        for (unsigned triple = 0; triple < tripleCount; ++triple) {
            uint16_t& best = orbitBest_[Triples::all().orbit(triple)];
            best = std::max(best, totals_[triple]);
        }
        const Gains uniform = gains_.transparent | gains_.opaque;
        for (unsigned number = 0; number < word2Count; ++number) {
            const Gains& word = gains_.words[number];
            allWords_ = allWords_ | word;
            alone_[number] = (word - uniform).total();
            mostOfOne_ = std::max(mostOfOne_, alone_[number]);
        }
        most_ = (allWords_ | uniform).total();
        for (unsigned bit = 0; bit < 4; ++bit) {
            for (unsigned value = 0; value < 2; ++value) {
                const unsigned mask = 1U << bit;
                pairWords_[0][bit][value] = PairWords(gains_, gains_.opaque, mask, value * mask);
                pairWords_[1][bit][value] = PairWords(gains_, gains_.transparent, mask, value * mask);
            }
        }
    }

    [[nodiscard]] const QuadrantGains& gains() const { return gains_; }

    // What no message with a triple of this orbit surpasses.
    [[nodiscard]] unsigned limit(unsigned orbit) const {
        return std::min(most_, orbitBest_[orbit] + mostOfOne_);
    }

    // The best reading with one of the first `transforms` transforms.
    Reading best(const Message& message, unsigned transforms) {
        Reading best;
        for (Transform t = 0; t < transforms; ++t) {
            const unsigned shown = Triples::all().shown(message.triple, t);
            if (t == 0 || totals_[shown] > best.total) best = {totals_[shown], t, false, false};
        }
        for (Transform t = 0; t < transforms; ++t) tryRereading(message, t, best);
        return best;
    }

    // Of a reading that re-reads: the gains of all words but the quadrant's own.
    [[nodiscard]] Gains baseOf(unsigned shownTriple, unsigned extra, bool opaqueIndex) const {
        const auto& words = Triples::all().words(shownTriple);
        return (opaqueIndex ? gains_.transparent : gains_.opaque) | gains_.words[words[0]] |
               gains_.words[words[1]] | gains_.words[words[2]] | gains_.words[extra];
    }

    // The best own pair that says which index re-reads.
    [[nodiscard]] BestPair bestOwn(Gains base, Transform transform, bool opaqueIndex) const {
        return bestPair(gains_, base, pairWords_[opaqueIndex ? 1 : 0][messageBit(transform)], opaqueIndex);
    }

  private:
    void tryRereading(const Message& message, Transform t, Reading& best) {
        const unsigned shown = Triples::all().shown(message.triple, t);
        const unsigned word = Triples::all().words(message.triple)[message.first];
        const unsigned extra = transformedWord2(t, transformedWord2(rotations[message.rotation], word));
        if (totals_[shown] + alone_[extra] <= best.total) return;
        const unsigned more = (gains_.words[extra] - gainsWith(gains_, shown)).total();
        if (totals_[shown] + more <= best.total) return;
        for (const bool opaqueIndex : {false, true}) {
            const Gains base = baseOf(shown, extra, opaqueIndex);
            if ((base | allWords_).total() <= best.total) continue;
            const unsigned total = bestOwn(base, t, opaqueIndex).total;
            if (total > best.total) best = {total, t, true, opaqueIndex};
        }
    }

    QuadrantGains gains_;
    TripleTotals totals_{};
    std::vector<uint16_t> orbitBest_;
    // [index 0 or 2 re-reads][message bit][its value]
    std::array<std::array<std::array<PairWords, 2>, 4>, 2> pairWords_;
    Gains allWords_;
    std::array<unsigned, word2Count> alone_{};  // what a word adds to the uniform ones
    unsigned mostOfOne_ = 0;
    unsigned most_ = 0;
};

// All messages, cut short by what the quadrants can gain at most.
class PlusSearch {
  public:
    explicit PlusSearch(std::array<PlusQuadrant, 4>& quadrants) : quadrants_(quadrants) {
        for (const auto& [limit, triple] : triplesByLimit()) {
            if (found_ && limit <= most_) break;
            for (unsigned first = 0; first < 3; ++first) {
                for (unsigned rotation = 0; rotation < rotations.size(); ++rotation) {
                    tryMessage({triple, first, rotation}, limit);
                }
            }
        }
    }

    [[nodiscard]] const Message& message() const { return message_; }
    [[nodiscard]] const std::array<Reading, 4>& readings() const { return best_; }

  private:
    // The most promising first, so that the search can end early.
    [[nodiscard]] std::vector<std::pair<unsigned, unsigned>> triplesByLimit() const {
        std::vector<unsigned> limits(Triples::all().orbitCount());
        for (unsigned orbit = 0; orbit < limits.size(); ++orbit) {
            for (const PlusQuadrant& quadrant : quadrants_) limits[orbit] += quadrant.limit(orbit);
        }
        std::vector<std::pair<unsigned, unsigned>> triples;
        for (unsigned triple = 0; triple < tripleCount; ++triple) {
            triples.emplace_back(limits[Triples::all().orbit(triple)], triple);
        }
        std::ranges::stable_sort(triples, [](const auto& a, const auto& b) { return a.first > b.first; });
        return triples;
    }

    void tryMessage(const Message& message, unsigned limit) {
        const unsigned orbit = Triples::all().orbit(message.triple);
        std::array<Reading, 4> readings;
        unsigned total = 0;
        for (unsigned q = 0; q < 4; ++q) {
            limit -= quadrants_[q].limit(orbit);
            readings[q] = quadrants_[q].best(message, q == 0 ? 1 : transformCount);
            total += readings[q].total;
            if (found_ && total + limit <= most_) return;
        }
        found_ = true;
        most_ = total;
        message_ = message;
        best_ = readings;
    }

    std::array<PlusQuadrant, 4>& quadrants_;
    bool found_ = false;
    unsigned most_ = 0;
    Message message_;
    std::array<Reading, 4> best_;
};

// The shared words so that they tell `message`: the re-read word first, then two that rise or fall.
std::array<Word2, 3> sharedWords(const Message& message) {
    const auto& words = Triples::all().words(message.triple);
    std::array<Word2, 3> codes{};
    for (unsigned k = 0; k < 3; ++k) codes[k] = word2Code(words[(message.first + k) % 3]);
    const bool falls = codes[1] > codes[2];
    if (falls != (rotations[message.rotation] == 6)) std::swap(codes[1], codes[2]);
    return codes;
}

// A word to stand beside `code` where the second is not needed, so that the pair still tells its message.
Word2 companion(Word2 code, bool different) {
    for (Word2 other = 1; other < 15; ++other) {
        if (other != code && ((code ^ other) & 1) == (different ? 1 : 0)) return other;
    }
    return 0;
}

// A quadrant's own words as stored.
std::array<Word2, 2> ownWords(const PlusQuadrant& quadrant, const Message& message, const Reading& reading) {
    const unsigned shown = Triples::all().shown(message.triple, reading.transform);
    std::array<Word2, 2> codes{};
    BestPair pair;
    if (reading.rereads) {
        const unsigned word = Triples::all().words(message.triple)[message.first];
        const unsigned extra =
            transformedWord2(reading.transform, transformedWord2(rotations[message.rotation], word));
        pair = quadrant.bestOwn(quadrant.baseOf(shown, extra, reading.opaqueIndex), reading.transform,
                                reading.opaqueIndex);
        if (pair.words[0] == noWord2) pair.words[0] = 0;
    } else {
        pair = bestPair(quadrant.gains(), gainsWith(quadrant.gains(), shown));
    }
    for (unsigned k = 0; k < 2; ++k) codes[k] = storedWord2(reading.transform, pair.words[k]);
    if (reading.rereads && pair.words[1] == noWord2) codes[1] = companion(codes[0], reading.opaqueIndex);
    if ((codes[0] > codes[1]) != reading.rereads) std::swap(codes[0], codes[1]);
    return codes;
}

}  // namespace

Vq2 bestVq2Plus(const std::array<Quadrant2, 4>& vectors, const Weights& weights) {
    std::array<PlusQuadrant, 4> quadrants{
        PlusQuadrant(vectors[0], weights), PlusQuadrant(vectors[1], weights),
        PlusQuadrant(vectors[2], weights), PlusQuadrant(vectors[3], weights)};
    const PlusSearch search(quadrants);
    Vq2 map;
    map.shared = sharedWords(search.message());
    for (unsigned q = 0; q < 4; ++q) {
        const Reading& reading = search.readings()[q];
        map.transforms[q] = reading.transform;
        map.own[q] = ownWords(quadrants[q], search.message(), reading);
    }
    return map;
}

}  // namespace filigree::quadmap
