#include "encoding/dag_nodes.h"

#include <algorithm>

#include <xxhash.h>

namespace filigree::encoding::dag {

uint32_t Nodes::intern(unsigned height, std::span<const uint32_t> words) {
    if (2 * (size() + 1) > slots_.size()) grow();
    const auto hash = static_cast<uint32_t>(XXH3_64bits(words.data(), words.size_bytes()));
    const uint32_t tag = (hash & ~heightMask) | height;
    const size_t mask = slots_.size() - 1;
    // Tags, not hashes, place nodes: so the table can grow without reading words again.
    size_t slot = (tag * 0x9e3779b97f4a7c15u >> 32) & mask;
    for (; slots_[slot] != 0; slot = (slot + 1) & mask) {
        const uint32_t number = slots_[slot] - 1;
        if (entries_[number].tag == tag && std::ranges::equal(this->words(number), words)) return number;
    }
    const auto number = static_cast<uint32_t>(size());
    slots_[slot] = number + 1;
    entries_.push_back({static_cast<uint32_t>(words_.size()), tag});
    words_.insert(words_.end(), words.begin(), words.end());
    return number;
}

void Nodes::grow() {
    slots_.assign(std::max<size_t>(256, 2 * slots_.size()), 0);
    const size_t mask = slots_.size() - 1;
    for (size_t number = 0; number < size(); ++number) {
        size_t slot = (entries_[number].tag * 0x9e3779b97f4a7c15u >> 32) & mask;
        while (slots_[slot] != 0) slot = (slot + 1) & mask;
        slots_[slot] = static_cast<uint32_t>(number + 1);
    }
}

}  // namespace filigree::encoding::dag
