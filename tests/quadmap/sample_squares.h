// Squares to try codecs on.
#pragma once

#include "filigree/quadmap/square.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace filigree::quadmap {

// Every region any of the first `kinds` states: 2 transparent and mixed, 3 opaque too, 4 free too.
inline Square randomSquare(unsigned side, unsigned kinds, std::mt19937& random) {
    Square square(side);
    for (Region& region : square.regions) region = static_cast<Region>(random() % kinds);
    return square;
}

// Leaf-like: a few discs and cut-outs, mixed along their outlines. No transparent region touches an opaque
// one.
inline Square leafySquare(unsigned side, std::mt19937& random) {
    struct Disc {
        double x, y, radius, sign;
    };
    std::vector<Disc> discs;
    const auto unit = [&] { return static_cast<double>(random() % 4096) / 4096; };
    for (unsigned k = 0; k < 3 + random() % 5; ++k) {
        discs.push_back({unit(), unit(), 0.08 + 0.3 * unit(), k % 3 == 2 ? -1.0 : 1.0});
    }
    Square square(side);
    const double margin = 0.75 / side;
    for (unsigned y = 0; y < side; ++y) {
        for (unsigned x = 0; x < side; ++x) {
            double inside = -1;
            for (const Disc& disc : discs) {
                const double depth =
                    disc.radius - std::hypot((x + 0.5) / side - disc.x, (y + 0.5) / side - disc.y);
                inside = disc.sign > 0 ? std::max(inside, depth) : std::min(inside, -depth);
            }
            square.at(x, y) = inside > margin    ? Region::opaque
                              : inside < -margin ? Region::transparent
                                                 : Region::mixed;
        }
    }
    return square;
}

// Nobody looks up what lies under the diagonal.
inline Square halfOf(Square square) {
    for (unsigned y = 0; y < square.side; ++y) {
        for (unsigned x = square.side - y; x < square.side; ++x) square.at(x, y) = Region::free;
    }
    return square;
}

// Squares of all sorts.
inline std::vector<Square> sampleSquares(unsigned side, unsigned count) {
    std::mt19937 random(side);
    std::vector<Square> squares{Square(side, Region::transparent), Square(side, Region::opaque), Square(side),
                                Square(side, Region::free)};
    while (squares.size() < count) {
        squares.push_back(leafySquare(side, random));
        squares.push_back(halfOf(leafySquare(side, random)));
        squares.push_back(randomSquare(side, 2 + squares.size() % 3, random));
    }
    return squares;
}

}  // namespace filigree::quadmap
