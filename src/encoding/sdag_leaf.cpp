#include "encoding/sdag_leaf.h"

#include <xxhash.h>

namespace filigree::encoding::sdag {
namespace {

using micromap::symmetryCount;
using micromap::turnedDigit;

struct TurnTables {
    std::array<std::array<uint8_t, 16>, symmetryCount> grandchildren{};
    // What byte k of a pattern, four states, adds to the turned one.
    std::array<std::array<std::array<Pattern, 256>, 4>, symmetryCount> bytes{};

    TurnTables() {
        for (unsigned s = 0; s < symmetryCount; ++s) {
            for (unsigned upper = 0; upper < 4; ++upper) {
                for (unsigned lower = 0; lower < 4; ++lower) {
                    grandchildren[s][grandchild(upper, lower)] =
                        static_cast<uint8_t>(grandchild(turnedDigit(upper, s), turnedDigit(lower, s)));
                }
            }
            for (unsigned at = 0; at < 4; ++at) fillBytes(s, at);
        }
    }

    void fillBytes(unsigned s, unsigned at) {
        for (unsigned byte = 0; byte < 256; ++byte) {
            for (unsigned k = 0; k < 4; ++k) {
                const Pattern state = (byte >> (2 * k)) & 3;
                bytes[s][at][byte] |= state << (2 * grandchildren[s][4 * at + k]);
            }
        }
    }
};

const TurnTables& tables() {
    static const TurnTables made;
    return made;
}

}  // namespace

unsigned turnedGrandchild(unsigned k, unsigned symmetry) {
    return tables().grandchildren[symmetry][k];
}

Pattern turned(Pattern pattern, unsigned symmetry) {
    const auto& bytes = tables().bytes[symmetry];
    return bytes[0][pattern & 255] | bytes[1][(pattern >> 8) & 255] | bytes[2][(pattern >> 16) & 255] |
           bytes[3][pattern >> 24];
}

Leaf turned(const Leaf& leaf, unsigned symmetry) {
    Leaf result;
    for (unsigned k = 0; k < 16; ++k) {
        result.patterns[turnedGrandchild(k, symmetry)] = turned(leaf.patterns[k], symmetry);
    }
    return result;
}

uint64_t hash(const Leaf& leaf) {
    return XXH3_64bits(leaf.patterns.data(), sizeof(leaf.patterns));
}

}  // namespace filigree::encoding::sdag
