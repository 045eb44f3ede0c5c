#include "encoding/sdag_layout.h"

#include "filigree/core/bytes.h"

namespace filigree::encoding::sdag {

void writeHead(const Head& head, std::span<uint8_t> to) {
    uint8_t* p = to.data();
    storeLe(p, static_cast<uint8_t>(head.shares | head.flat_maps << 1));
    storeLe(p + 1, static_cast<uint8_t>(head.base_bytes));
    storeLe(p + 2, static_cast<uint8_t>(head.reference_bits));
    storeLe(p + 3, static_cast<uint8_t>(head.value_bits));
    storeLe(p + 4, head.levels);
    storeLe(p + 8, head.patterns);
    storeLe(p + 12, head.heads);
    for (unsigned slot = 0; slot < nodeHeights; ++slot) storeLe(p + 16 + 4 * slot, head.nodes[slot]);
    storeLe(p + 32, head.shared_bytes);
    storeLe(p + 36, head.block_bytes);
    storeLe(p + 40, head.flat_bytes);
}

}  // namespace filigree::encoding::sdag
