// Little-endian integers at any address.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace filigree {

// Reads an unsigned T from sizeof(T) bytes at `from`. One load on little-endian machines, which compilers do
// not always make of the shifts.
template <class T>
T loadLe(const uint8_t* from) {
    static_assert(std::is_unsigned_v<T>);
    T value = 0;
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(&value, from, sizeof(T));
    } else {
        for (size_t i = 0; i < sizeof(T); ++i)
            value = static_cast<T>(value | (static_cast<T>(from[i]) << (8 * i)));
    }
    return value;
}

// Writes an unsigned T to sizeof(T) bytes at `to`.
template <class T>
void storeLe(uint8_t* to, T value) {
    static_assert(std::is_unsigned_v<T>);
    for (size_t i = 0; i < sizeof(T); ++i) to[i] = static_cast<uint8_t>(value >> (8 * i));
}

}  // namespace filigree
