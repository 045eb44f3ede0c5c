#include "encoding/dag_build.h"

#include <bit>

namespace filigree::encoding::dag {

using micromap::Format;

namespace {

// Every second bit, from the lowest on, closed up.
uint32_t evenBits(uint32_t bits) {
    bits &= 0x55555555;
    bits = (bits | (bits >> 1)) & 0x33333333;
    bits = (bits | (bits >> 2)) & 0x0f0f0f0f;
    bits = (bits | (bits >> 4)) & 0x00ff00ff;
    return (bits | (bits >> 8)) & 0x0000ffff;
}

// The four states of the quadtree node of height 1 that `bits` starts with, and how many bits it takes.
struct Four {
    uint32_t states;
    unsigned bits;
};
Four fourStates(uint64_t bits) {
    if ((bits & 1) != 0) return {static_cast<uint32_t>(bits >> 1) & 0xff, 9};
    return {(static_cast<uint32_t>(bits >> 1) & 3) * 0x55, 3};
}

}  // namespace

uint32_t Builder::add(const micromap::QuadtreeView& tree) {
    tree_ = tree;
    at_ = 0;
    const unsigned height = rootHeight(tree.level);
    Parts parts{};
    if (tree.level < blockHeight) {
        parts[0] = paddedBlock(tree.level);
    } else {
        fill(tree.level, height - 2, parts.data());
    }
    uint64_t opaque = 0;
    for (const Part& p : parts) opaque += p.opaque;
    return intern(height, parts, opaque);
}

// The quadtree node that comes next, of an even height, as a child.
Builder::Part Builder::part(unsigned height) {
    if (height == blockHeight) return block();
    const uint64_t bits = peek();
    if ((bits & 1) == 0) {
        at_ += 3;
        return uniform(height, (bits >> 1) & 3);
    }
    Parts parts{};
    fill(height, height - 2, parts.data());
    return node(height, parts);
}

// The quadtree node that comes next, as its descendants of height `partHeight`.
void Builder::fill(unsigned height, unsigned partHeight, Part* parts) {
    if (height == partHeight) {
        *parts = part(height);
        return;
    }
    const size_t quarter = micromap::microTriangleCount(height - 1 - partHeight);
    const uint64_t bits = peek();
    if ((bits & 1) != 0) {
        ++at_;
        for (size_t k = 0; k < 4; ++k) fill(height - 1, partHeight, parts + k * quarter);
    } else {
        at_ += 3;
        std::fill_n(parts, 4 * quarter, uniform(partHeight, (bits >> 1) & 3));
    }
}

// The quadtree node of height 2 that comes next: at most 37 bits.
Builder::Part Builder::block() {
    uint64_t bits = peek();
    if ((bits & 1) == 0) {
        at_ += 3;
        return blockOf((static_cast<uint32_t>(bits >> 1) & 3) * 0x55555555);
    }
    bits >>= 1;
    ++at_;
    uint32_t states = 0;
    for (unsigned k = 0; k < 4; ++k) {
        const Four four = fourStates(bits);
        states |= four.states << (8 * k);
        bits >>= four.bits;
        at_ += four.bits;
    }
    return blockOf(states);
}

// A whole map of level 0 or 1.
Builder::Part Builder::paddedBlock(unsigned level) {
    const uint64_t bits = peek();
    return blockOf(level == 0 ? static_cast<uint32_t>(bits) & 3 : fourStates(bits).states);
}

Builder::Part Builder::blockOf(uint32_t states) const {
    const uint32_t sides = evenBits(states);
    return {format_ == Format::fourState ? states : sides, static_cast<uint32_t>(std::popcount(sides))};
}

Builder::Part Builder::uniform(unsigned height, uint32_t state) {
    if (height == blockHeight) return blockOf(state * 0x55555555);
    Part& known = uniform_[height / 2][state];
    if (known.value == 0) {
        Parts parts;
        parts.fill(uniform(height - 2, state));
        known = node(height, parts);
    }
    return known;
}

Builder::Part Builder::node(unsigned height, const Parts& parts) {
    uint32_t present = 0;
    uint32_t opaque = 0;
    for (const Part& p : parts) {
        present |= p.value;
        opaque += p.opaque;
    }
    if (present == 0) return {};
    return {intern(height, parts, opaque) + 1, opaque};
}

uint32_t Builder::intern(unsigned height, const Parts& parts, uint64_t opaque) {
    std::array<uint32_t, 1 + children> words{};
    unsigned present = 0;
    uint32_t mask = 0;
    const bool halves = height == leafHeight && format_ == Format::twoState;
    for (unsigned k = 0; k < children; ++k) {
        if (parts[k].value == 0) continue;
        mask |= 1u << k;
        if (halves) {
            words[1 + present / 2] |= parts[k].value << (16 * (present % 2));
        } else {
            words[1 + present] = height == leafHeight ? parts[k].value : parts[k].value - 1;
        }
        ++present;
    }
    words[0] = mask | (shareOf(opaque, height) << 16);
    return nodes_.intern(height, std::span(words).first(1 + (halves ? (present + 1) / 2 : present)));
}

}  // namespace filigree::encoding::dag
