#include "filigree/quadmap/encode.h"

#include "quadmap/vq2_best.h"
#include "quadmap/vq2_paper.h"

namespace filigree::quadmap {

Vq2Block encodeVq2(const Square& square, Vq2Method method, Prefer prefer) {
    const auto quadrants = quadrantsOf(square);
    const Weights weights = weightsOf(prefer);
    Vq2 map = method == Vq2Method::best ? bestVq2(quadrants, weights)
                                        : paperVq2(quadrants, method == Vq2Method::paperLiteral);
    for (unsigned q = 0; q < 4; ++q) assignIndices(quadrants[q], shownWords(map, q), weights, q, map);
    return pack(map);
}

Vq2Block encodeVq2Plus(const Square& square, Prefer prefer) {
    const auto quadrants = quadrantsOf(square);
    const Weights weights = weightsOf(prefer);
    Vq2 map = bestVq2Plus(quadrants, weights);
    for (unsigned q = 0; q < 4; ++q) assignIndices(quadrants[q], shownPlusWords(map, q), weights, q, map);
    return pack(map);
}

}  // namespace filigree::quadmap
