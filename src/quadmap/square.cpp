#include "filigree/quadmap/square.h"

namespace filigree::quadmap {

double savings(const Square& square) {
    size_t known = 0;
    size_t wanted = 0;
    for (const Region region : square.regions) {
        known += isKnown(region) ? 1 : 0;
        wanted += region != Region::free ? 1 : 0;
    }
    return wanted == 0 ? 0 : static_cast<double>(known) / static_cast<double>(wanted);
}

uint32_t substitutions(const Square& source, const Square& map) {
    assert(source.side == map.side);
    uint32_t count = 0;
    for (size_t k = 0; k < source.regions.size(); ++k) {
        count += isKnown(source.regions[k]) && !isKnown(map.regions[k]) ? 1 : 0;
    }
    return count;
}

bool isConservative(const Square& source, const Square& map) {
    if (source.side != map.side) return false;
    for (size_t k = 0; k < source.regions.size(); ++k) {
        const Region wanted = source.regions[k];
        if (isKnown(map.regions[k]) && map.regions[k] != wanted && wanted != Region::free) return false;
    }
    return true;
}

}  // namespace filigree::quadmap
