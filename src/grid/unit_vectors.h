// How the unit vectors of the codec `paper` stand (docs/spec/paper.md): in rings around the y axis.
#pragma once

#include "filigree/grid/paper.h"

#include <array>

namespace filigree::grid {

inline constexpr unsigned paperRings = 39;  // and ring 0, the axis itself

struct UnitVectorRings {
    UnitVectors vectors;
    std::array<unsigned, paperRings + 1> first{};  // vector of each ring
    std::array<unsigned, paperRings + 1> steps{};  // a ring has so many vectors and one more
};
const UnitVectorRings& unitVectorRings();

}  // namespace filigree::grid
