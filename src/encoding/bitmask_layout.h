// Constants of docs/spec/bitmask.md.
#pragma once

#include "filigree/encoding/bitmask.h"

#include <cstddef>
#include <cstdint>

namespace filigree::encoding::bitmask {

inline constexpr size_t descriptorBytes = 12;
inline constexpr size_t widthAt = 4;
inline constexpr size_t heightAt = 6;
inline constexpr size_t flagsAt = 8;
inline constexpr unsigned wrapVShift = 2;
inline constexpr unsigned nearestFlag = 16;

inline uint64_t cellCount(const BitmaskAxis& columns, const BitmaskAxis& rows) {
    return uint64_t{columns.cells()} * rows.cells();
}

inline uint64_t maskBytes(const BitmaskAxis& columns, const BitmaskAxis& rows, micromap::Format format) {
    return (cellCount(columns, rows) * micromap::bitsPerState(format) + 7) / 8;
}

}  // namespace filigree::encoding::bitmask
