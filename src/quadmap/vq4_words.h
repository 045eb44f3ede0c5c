// 4 x 4 vectors and words as sets of regions, bit 4y + x each.
#pragma once

#include "filigree/quadmap/encode.h"
#include "filigree/quadmap/vq4.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::quadmap {

// A vector of the square. It may have both states in one 2 x 2 part where a pair's texture coordinates jump.
struct Vector4 {
    uint16_t transparent = 0;
    uint16_t opaque = 0;
    uint16_t free = 0;
    friend bool operator==(const Vector4&, const Vector4&) = default;
};

// The regions that a word knows.
struct States4 {
    uint16_t transparent = 0;
    uint16_t opaque = 0;
    [[nodiscard]] bool empty() const { return (transparent | opaque) == 0; }
    friend bool operator==(const States4&, const States4&) = default;
};

Vector4 transformed(Transform transform, const Vector4& vector);
States4 transformed(Transform transform, const States4& states);

// The simplest kind that holds a word; `halves` fits vertical and horizontal alike.
enum class Shape4 : uint8_t { simple, halves, vertical, horizontal, generic };
inline constexpr unsigned shapeCount = 5;
Shape4 shapeOf(const States4& word);

// What both states in one 2 x 2 part leave: the one with more regions there, transparent of equals.
States4 representable(States4 word);
// The part of a word that fits a kind: in each piece that has one palette the state with more regions.
States4 reduced(States4 word, Word4Kind kind);

// How many words of each shape a codebook has.
using ShapeCounts = std::array<unsigned, shapeCount>;
// True where the layout has a place for all of them.
bool fits(const ShapeCounts& counts, Vq4Layout layout);

// What a square of side 32 asks of its map: for each group the vectors that no uniform word keeps whole.
struct Demand4 {
    Vq4Layout layout = Vq4Layout::vq4;
    Weights weights;
    // [group][transform]: as they look when stored
    std::array<std::array<std::vector<Vector4>, transformCount>, 8> stored;
    unsigned total = 0;  // the weight of all their known regions
};
Demand4 demandOf(const Square& square, Vq4Layout layout, const Weights& weights);

// What a search decides.
struct Book4 {
    std::array<Transform, 8> transforms{};
    std::vector<States4> words;  // at most word4Count; stored
};

// The map for a book, with the best index for each vector. The words fit the layout.
Vq4 mapOf(const Square& square, Book4 book, Vq4Layout layout, const Weights& weights);

}  // namespace filigree::quadmap
