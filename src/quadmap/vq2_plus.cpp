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

// The codes' lowest bits, as stored, name the index: where they lie once transformed.
PairRule ruleOf(Transform transform, bool opaqueIndex) {
    const uint32_t shown = transformedCells(transform, 2, 1);
    return {false, static_cast<unsigned>(std::countr_zero(shown)), opaqueIndex};
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
        for (const Gains& word : gains_.words) {
            allWords_ = allWords_ | word;
            mostOfOne_ = std::max(mostOfOne_, (word - uniform).total());
        }
        most_ = (allWords_ | uniform).total();
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

  private:
    void tryRereading(const Message& message, Transform t, Reading& best) {
        const unsigned shown = Triples::all().shown(message.triple, t);
        const unsigned word = Triples::all().words(message.triple)[message.first];
        const unsigned extra = transformedWord2(t, transformedWord2(rotations[message.rotation], word));
        const unsigned more = (gains_.words[extra] - gainsWith(gains_, shown)).total();
        if (totals_[shown] + more <= best.total) return;
        for (const bool opaqueIndex : {false, true}) {
            const Gains base = baseOf(shown, extra, opaqueIndex);
            if ((base | allWords_).total() <= best.total) continue;
            const unsigned total = bestPair(gains_, base, ruleOf(t, opaqueIndex)).total;
            if (total > best.total) best = {total, t, true, opaqueIndex};
        }
    }

    QuadrantGains gains_;
    TripleTotals totals_{};
    std::vector<uint16_t> orbitBest_;
    Gains allWords_;
    unsigned mostOfOne_ = 0;
    unsigned most_ = 0;
};

// All messages, cut short by what the quadrants can gain at most.
class PlusSearch {
  public:
    explicit PlusSearch(std::array<PlusQuadrant, 4>& quadrants) : quadrants_(quadrants) {
        for (unsigned triple = 0; triple < tripleCount; ++triple) {
            const unsigned orbit = Triples::all().orbit(triple);
            unsigned limit = 0;
            for (const PlusQuadrant& quadrant : quadrants_) limit += quadrant.limit(orbit);
            for (unsigned first = 0; limit > most_ && first < 3; ++first) {
                for (unsigned rotation = 0; rotation < rotations.size(); ++rotation) {
                    tryMessage({triple, first, rotation}, limit);
                }
            }
        }
    }

    [[nodiscard]] const Message& message() const { return message_; }
    [[nodiscard]] const std::array<Reading, 4>& readings() const { return best_; }

  private:
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
        pair = bestPair(quadrant.gains(), quadrant.baseOf(shown, extra, reading.opaqueIndex),
                        ruleOf(reading.transform, reading.opaqueIndex));
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
