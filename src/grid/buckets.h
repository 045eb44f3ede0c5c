// Counting sort.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::grid {

inline constexpr uint32_t noBucket = 0xffffffff;

// Numbers sorted into buckets: those of bucket b stand at [starts[b], starts[b + 1]), rising.
struct Buckets {
    std::vector<uint32_t> starts;
    std::vector<uint32_t> items;

    // keyOf(item) is a bucket below `buckets`, or noBucket for items left out.
    template <class KeyOf>
    Buckets(size_t buckets, size_t itemCount, const KeyOf& keyOf) : starts(buckets + 1) {
        for (size_t item = 0; item < itemCount; ++item) {
            const uint32_t key = keyOf(item);
            if (key != noBucket) ++starts[key + 1];
        }
        for (size_t b = 0; b < buckets; ++b) starts[b + 1] += starts[b];
        items.resize(starts[buckets]);
        std::vector<uint32_t> next(starts.begin(), starts.end() - 1);
        for (size_t item = 0; item < itemCount; ++item) {
            const uint32_t key = keyOf(item);
            if (key != noBucket) items[next[key]++] = static_cast<uint32_t>(item);
        }
    }
    [[nodiscard]] std::span<uint32_t> bucket(size_t b) {
        return std::span(items).subspan(starts[b], starts[b + 1] - starts[b]);
    }
};

}  // namespace filigree::grid
