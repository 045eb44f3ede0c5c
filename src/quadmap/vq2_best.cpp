// The optimum over all transforms and codebooks. Given the shared words, quadrants are independent; and what
// a quadrant makes of the transformed words depends on their orbit alone, since it may choose its transform.
#include "quadmap/vq2_best.h"

#include "quadmap/vq2_triples.h"

namespace filigree::quadmap {
namespace {

struct Search {
    std::array<QuadrantGains, 4> gains;
    std::array<TripleTotals, 4> totals;

    Search(const std::array<Quadrant2, 4>& quadrants, const Weights& weights) {
        for (unsigned q = 0; q < 4; ++q) {
            gains[q] = gainsOf(quadrants[q], weights);
            totalsOfTriples(gains[q], totals[q]);
        }
    }
};

// The orbit whose best triples add up to the most, the first of equals.
unsigned bestOrbit(const Search& search) {
    const Triples& triples = Triples::all();
    std::vector<unsigned> sums(triples.orbitCount());
    std::vector<uint16_t> most(triples.orbitCount());
    for (const TripleTotals& totals : search.totals) {
        std::ranges::fill(most, uint16_t{0});
        for (unsigned triple = 0; triple < tripleCount; ++triple) {
            uint16_t& orbit = most[triples.orbit(triple)];
            orbit = std::max(orbit, totals[triple]);
        }
        for (size_t orbit = 0; orbit < sums.size(); ++orbit) sums[orbit] += most[orbit];
    }
    return static_cast<unsigned>(std::ranges::max_element(sums) - sums.begin());
}

Transform bestTransform(const TripleTotals& totals, unsigned triple) {
    Transform best = 0;
    for (Transform t = 1; t < transformCount; ++t) {
        if (totals[Triples::all().shown(triple, t)] > totals[Triples::all().shown(triple, best)]) best = t;
    }
    return best;
}

}  // namespace

Vq2 bestVq2(const std::array<Quadrant2, 4>& quadrants, const Weights& weights) {
    const Search search(quadrants, weights);
    const Triples& triples = Triples::all();
    const unsigned orbit = bestOrbit(search);
    unsigned stored = tripleCount;
    for (unsigned triple = 0; triple < tripleCount; ++triple) {
        if (triples.orbit(triple) != orbit) continue;
        if (stored == tripleCount || search.totals[0][triple] > search.totals[0][stored]) stored = triple;
    }
    Vq2 map;
    for (unsigned k = 0; k < 3; ++k) map.shared[k] = word2Code(triples.words(stored)[k]);
    for (unsigned q = 0; q < 4; ++q) {
        const Transform transform = q == 0 ? Transform{0} : bestTransform(search.totals[q], stored);
        const Gains base = gainsWith(search.gains[q], triples.shown(stored, transform));
        const BestPair pair = bestPair(search.gains[q], base);
        map.transforms[q] = transform;
        for (unsigned k = 0; k < 2; ++k) map.own[q][k] = storedWord2(transform, pair.words[k]);
    }
    return map;
}

}  // namespace filigree::quadmap
