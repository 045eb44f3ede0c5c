// Encoders of squares. All are conservative: a region that decodes to transparent or opaque is so in the
// source, or free there. Same square, same block.
#pragma once

#include "filigree/core/api.h"
#include "filigree/quadmap/square.h"
#include "filigree/quadmap/vq2.h"
#include "filigree/quadmap/vq4.h"

namespace filigree::quadmap {

// Which known state is worth more when not all can be kept (Fenney and Ozkan 2023, section 6): keeping a
// region of the preferred state counts twice. The `paper` encoders choose their codebooks regardless.
enum class Prefer : uint8_t { neither, transparent, opaque };

// What keeping a region counts.
struct Weights {
    unsigned transparent = 1;
    unsigned opaque = 1;
};
constexpr Weights weightsOf(Prefer prefer) {
    return {prefer == Prefer::transparent ? 2U : 1U, prefer == Prefer::opaque ? 2U : 1U};
}

// Algorithm 1 of the paper leaves its score open, so there are two readings: `paperLiteral` takes first what
// has the lowest sum of mixed regions over all its occurrences, `paperSensible` what has the highest sum of
// known ones. `best` is the optimum over all transforms and codebooks.
enum class Vq2Method : uint8_t { paperLiteral, paperSensible, best };

// A square of side 16 as VQ2.
FILIGREE_API Vq2Block encodeVq2(const Square& square, Vq2Method method, Prefer prefer = Prefer::neither);

// A square of side 16 as VQ2+, optimal over all transforms, codebooks and readings.
FILIGREE_API Vq2Block encodeVq2Plus(const Square& square, Prefer prefer = Prefer::neither);

// `paper` is algorithm 2. `fast` and `best` choose words among the intersections of two vectors each, swap
// them while that helps, and follow one or several books as quadrants join; `best` then perturbs what it
// found.
enum class Vq4Method : uint8_t { paper, fast, best };

// A square of side 32 as VQ4 or VQ4+.
FILIGREE_API Vq4Block encodeVq4(const Square& square, Vq4Method method, Prefer prefer = Prefer::neither);
FILIGREE_API Vq4Block encodeVq4Plus(const Square& square, Vq4Method method, Prefer prefer = Prefer::neither);

}  // namespace filigree::quadmap
