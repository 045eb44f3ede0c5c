// Decoded tiles and blocks of one thread.
#pragma once

#include "grid/block.h"

#include <cstdint>
#include <vector>

namespace filigree::grid {

// Direct-mapped. Where hardly anything is found again, nothing is kept: filling costs memory traffic.
template <class T>
class Cache {
  public:
    explicit Cache(size_t entries) : keys_(entries, noKey), values_(entries), mask_(entries - 1) {}

    // The value of `key`; make(value) fills it where it is not there. Valid until the next call.
    template <class Make>
    const T& get(uint64_t key, const Make& make) {
        if (isOff()) {
            make(spare_);
            return spare_;
        }
        const size_t at = key & mask_;
        ++asked_;
        if (keys_[at] == key) {
            ++found_;
            return values_[at];
        }
        keys_[at] = key;
        make(values_[at]);
        return values_[at];
    }

    [[nodiscard]] uint64_t bytes() const {
        return keys_.size() * sizeof(uint64_t) + values_.size() * sizeof(T) + sizeof(*this);
    }

  private:
    static constexpr uint64_t noKey = ~uint64_t{0};
    // Looks at so many requests, then stays off for a while where too few were found.
    static constexpr uint32_t trial = 1024;
    static constexpr uint32_t rest = 16 * trial;
    static constexpr uint32_t worth = trial / 8;

    bool isOff() {
        if (resting_ > 0) {
            --resting_;
            return true;
        }
        if (asked_ == trial) {
            if (found_ < worth) resting_ = rest;
            asked_ = 0;
            found_ = 0;
        }
        return false;
    }

    std::vector<uint64_t> keys_;
    std::vector<T> values_;
    size_t mask_;
    T spare_{};
    uint32_t asked_ = 0;
    uint32_t found_ = 0;
    uint32_t resting_ = 0;
};

struct BlockCache {
    // Powers of two; together they fit a second-level cache.
    Cache<TileBlocks> tiles{256};
    Cache<Block> blocks{1024};
    [[nodiscard]] uint64_t bytes() const { return tiles.bytes() + blocks.bytes(); }
};

}  // namespace filigree::grid
