// Bit fields of one 64-bit word, the lowest first.
#pragma once

#include <cassert>
#include <cstdint>

namespace filigree::quadmap {

struct Fields {
    uint64_t bits = 0;
    uint8_t take(unsigned count) {
        const auto field = static_cast<uint8_t>(bits & ((1U << count) - 1));
        bits >>= count;
        return field;
    }
};

struct Packed {
    uint64_t bits = 0;
    unsigned used = 0;
    void put(unsigned field, unsigned count) {
        assert(field < 1U << count && used + count <= 64);
        bits |= uint64_t{field} << used;
        used += count;
    }
};

}  // namespace filigree::quadmap
