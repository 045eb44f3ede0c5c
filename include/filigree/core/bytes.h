// Little-endian integers at any address, written with explicit shifts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace filigree {

// Reads an unsigned T from sizeof(T) bytes at `from`.
template <class T>
T loadLe(const uint8_t* from) {
    static_assert(std::is_unsigned_v<T>);
    T value = 0;
    for (size_t i = 0; i < sizeof(T); ++i)
        value = static_cast<T>(value | (static_cast<T>(from[i]) << (8 * i)));
    return value;
}

// Writes an unsigned T to sizeof(T) bytes at `to`.
template <class T>
void storeLe(uint8_t* to, T value) {
    static_assert(std::is_unsigned_v<T>);
    for (size_t i = 0; i < sizeof(T); ++i) to[i] = static_cast<uint8_t>(value >> (8 * i));
}

}  // namespace filigree
