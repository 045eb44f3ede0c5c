#include "filigree/encoding/sdag.h"

#include <cassert>

namespace filigree::encoding {

void SdagReader::lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                        std::span<micromap::State> states) const {
    for (size_t k = 0; k < maps.size(); ++k) states[k] = at(maps[k], indices[k]);
}

void SdagReader::lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                        std::span<micromap::State> states) const {
    for (size_t k = 0; k < maps.size(); ++k) states[k] = at(maps[k], u[k], v[k]);
}

}  // namespace filigree::encoding
