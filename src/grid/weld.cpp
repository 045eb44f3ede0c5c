#include "grid/weld.h"

#include <array>
#include <bit>
#include <cassert>

namespace filigree::grid {
namespace {

constexpr uint32_t noVertex = 0xffffffff;
constexpr size_t wordsPerVertex = 8;
using VertexWords = std::array<uint32_t, wordsPerVertex>;

// Adding 0 turns -0 into 0.
uint32_t wordOf(float value) {
    return std::bit_cast<uint32_t>(value + 0.0F);
}

VertexWords wordsOfVertex(const WeldInput& input, size_t v) {
    VertexWords words{};
    for (size_t k = 0; k < 3; ++k) words[k] = wordOf(input.positions[v][k]);
    if (!input.normals.empty()) {
        for (size_t k = 0; k < 3; ++k) words[3 + k] = wordOf(input.normals[v][k]);
    }
    if (!input.uvs.empty()) {
        words[6] = wordOf(input.uvs[v].u);
        words[7] = wordOf(input.uvs[v].v);
    }
    return words;
}

uint64_t hashOf(const VertexWords& words) {
    uint64_t hash = 0x9e3779b97f4a7c15;
    for (size_t k = 0; k < wordsPerVertex; k += 2) {
        hash ^= words[k] | uint64_t{words[k + 1]} << 32;
        hash *= 0xff51afd7ed558ccd;
        hash ^= hash >> 32;
    }
    return hash;
}

}  // namespace

std::vector<uint32_t> weld(const WeldInput& input) {
    const size_t count = input.positions.size();
    assert(count < noVertex);
    const uint64_t mask = std::bit_ceil(2 * count + 1) - 1;
    std::vector<uint32_t> slots(mask + 1, noVertex);
    std::vector<uint32_t> firsts(count);
    for (size_t v = 0; v < count; ++v) {
        const VertexWords words = wordsOfVertex(input, v);
        uint64_t at = hashOf(words) & mask;
        while (slots[at] != noVertex && wordsOfVertex(input, slots[at]) != words) at = (at + 1) & mask;
        if (slots[at] == noVertex) slots[at] = static_cast<uint32_t>(v);
        firsts[v] = slots[at];
    }
    return firsts;
}

}  // namespace filigree::grid
