#include "quadmap/vq4_paper.h"

#include "quadmap/vq4_book.h"

#include <algorithm>
#include <bit>

namespace filigree::quadmap {
namespace {

// A vector as the paper sees it: every region transparent, opaque or mixed, and how often it occurs.
struct Counted {
    States4 states;
    unsigned count = 0;
};

unsigned sizeOf(const States4& states) {
    return static_cast<unsigned>(std::popcount(states.transparent) + std::popcount(states.opaque));
}

States4 both(const States4& a, const States4& b) {
    return {static_cast<uint16_t>(a.transparent & b.transparent), static_cast<uint16_t>(a.opaque & b.opaque)};
}

// Vectors that one word stands for: their best compatible vector, or the mixed one.
struct Partition {
    std::vector<Counted> members;
    States4 word;
    bool mixed = false;
    unsigned loss = 0;
};

// The loss of members whose known regions add up to `known`, `count` of them, under `word`.
unsigned lossOf(unsigned known, unsigned count, const States4& word) {
    return known - count * sizeOf(word);
}

// What a cut would leave on one of its sides.
struct Side {
    States4 word{0xffff, 0xffff};
    unsigned known = 0;
    unsigned count = 0;

    void add(const Counted& member) {
        word = both(word, member.states);
        known += member.count * sizeOf(member.states);
        count += member.count;
    }
    void add(const Side& other) {
        word = both(word, other.word);
        known += other.known;
        count += other.count;
    }
    [[nodiscard]] unsigned loss() const { return lossOf(known, count, word); }
};

// 0 transparent, 1 mixed, 2 opaque.
unsigned valueAt(const States4& states, unsigned cell) {
    return (states.transparent >> cell & 1) != 0 ? 0 : (states.opaque >> cell & 1) != 0 ? 2 : 1;
}

// One region's value against its others.
struct Cut {
    unsigned cell = 0;
    unsigned value = 0;
    unsigned loss = UINT32_MAX;
    bool firstMixed = false;  // of a mixed partition: the side with `value` stays mixed, not the other
};

Cut bestCut(const Partition& partition) {
    Cut best;
    for (unsigned cell = 0; cell < 16; ++cell) {
        std::array<Side, 3> sides;
        for (const Counted& member : partition.members) sides[valueAt(member.states, cell)].add(member);
        for (unsigned value = 0; value < 3; ++value) {
            Side rest = sides[(value + 1) % 3];
            rest.add(sides[(value + 2) % 3]);
            if (sides[value].count == 0 || rest.count == 0) continue;
            const auto offer = [&](unsigned loss, bool firstMixed) {
                if (loss < best.loss) best = {cell, value, loss, firstMixed};
            };
            if (partition.mixed) {
                offer(sides[value].known + rest.loss(), true);
                offer(sides[value].loss() + rest.known, false);
            } else {
                offer(sides[value].loss() + rest.loss(), false);
            }
        }
    }
    return best;
}

Partition partitionOf(std::vector<Counted> members, bool mixed) {
    Side side;
    for (const Counted& member : members) side.add(member);
    return {std::move(members), side.word, mixed, mixed ? side.known : side.loss()};
}

std::vector<States4> createCodebook(std::vector<Counted> merged) {
    if (merged.empty()) return {};
    std::vector<Partition> partitions;
    partitions.push_back(partitionOf(std::move(merged), true));
    // The mixed partition has the uniform index and no place in the book.
    while (partitions.size() < word4Count + 1) {
        const auto worst = std::ranges::max_element(partitions, {}, &Partition::loss);
        if (worst->loss == 0) break;
        const Cut cut = bestCut(*worst);
        if (cut.loss == UINT32_MAX) {
            // One kind of vector is left, and mixed: it gets its own word.
            worst->mixed = false;
            *worst = partitionOf(std::move(worst->members), false);
            continue;
        }
        std::vector<Counted> first;
        std::vector<Counted> second;
        for (const Counted& member : worst->members) {
            (valueAt(member.states, cut.cell) == cut.value ? first : second).push_back(member);
        }
        const bool mixed = worst->mixed;
        *worst = partitionOf(std::move(first), mixed && cut.firstMixed);
        partitions.push_back(partitionOf(std::move(second), mixed && !cut.firstMixed));
    }
    std::vector<States4> words;
    for (const Partition& partition : partitions) {
        if (!partition.mixed && !partition.word.empty()) words.push_back(partition.word);
    }
    if (words.size() > word4Count) words.resize(word4Count);
    return words;
}

// The paper knows no free regions, which become mixed, and no jumps.
States4 statesOf(const Vector4& vector) {
    return representable({vector.transparent, vector.opaque});
}

// The vectors under these transforms, equal ones merged, in the order of their bits.
std::vector<Counted> mergedVectors(const Demand4& demand, const std::array<Transform, 8>& transforms,
                                   VectorLanes& lanes) {
    std::vector<uint32_t> keys;
    for (unsigned group = 0; group < groupCount(demand.layout); ++group) {
        for (const Vector4& vector : demand.stored[group][transforms[group]]) {
            const States4 states = statesOf(vector);
            keys.push_back(states.transparent | uint32_t{states.opaque} << 16);
            lanes.add(vector);
        }
    }
    std::ranges::sort(keys);
    std::vector<Counted> merged;
    for (const uint32_t key : keys) {
        const States4 states{static_cast<uint16_t>(key), static_cast<uint16_t>(key >> 16)};
        if (merged.empty() || merged.back().states != states) merged.push_back({states, 0});
        ++merged.back().count;
    }
    return merged;
}

}  // namespace

Book4 paperVq4(const Demand4& demand) {
    Book4 best;
    int most = -1;
    const unsigned groupsOfQuadrant = groupCount(demand.layout) / 4;
    for (unsigned combination = 0; combination < 512; ++combination) {
        Book4 book;
        for (unsigned group = groupsOfQuadrant; group < groupCount(demand.layout); ++group) {
            const unsigned quadrant = group / groupsOfQuadrant;
            book.transforms[group] = static_cast<Transform>(combination >> (9 - 3 * quadrant) & 7);
        }
        VectorLanes lanes;
        book.words = createCodebook(mergedVectors(demand, book.transforms, lanes));
        book.words = fitted(std::move(book.words), lanes, demand.layout, demand.weights);
        const auto total = static_cast<int>(bookGain(lanes, book.words, demand.weights));
        if (total <= most) continue;
        most = total;
        best = std::move(book);
        if (total == static_cast<int>(demand.total)) break;
    }
    return best;
}

}  // namespace filigree::quadmap
