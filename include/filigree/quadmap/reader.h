// Arrays of encoded squares, looked up where a ray hits their pairs of triangles.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/quadmap/place.h"
#include "filigree/quadmap/square.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace filigree::quadmap {

// The raw formats hold two bits a region, row by row, to compare with: 512 and 2048 bits.
enum class SquareFormat : uint8_t { vq2, vq2Plus, vq4, vq4Plus, raw16, raw32 };
inline constexpr unsigned squareFormatCount = 6;

FILIGREE_API std::string_view nameOf(SquareFormat format);  // "vq2", "vq2+", "vq4", "vq4+", "raw16", "raw32"
FILIGREE_API unsigned sideOf(SquareFormat format);          // regions along an edge
FILIGREE_API size_t blockBytesOf(SquareFormat format);      // bytes of a map

// Maps one after the other, without gaps. Views memory that must outlive it. Lookups check nothing.
class FILIGREE_API SquareReader {
  public:
    // Fails with ErrorKind::format where the bytes are no whole number of maps, and for a raw region of
    // value 3. In the other formats all bits are maps.
    static Result<SquareReader> open(SquareFormat format, std::span<const uint8_t> bytes);

    [[nodiscard]] SquareFormat format() const { return format_; }
    [[nodiscard]] size_t mapCount() const { return bytes_.size() / blockBytesOf(format_); }

    // All maps.
    [[nodiscard]] std::span<const uint8_t> bytes() const { return bytes_; }
    // The bytes of a map.
    [[nodiscard]] std::span<const uint8_t> block(size_t map) const {
        return bytes_.subspan(map * blockBytesOf(format_), blockBytesOf(format_));
    }

    // The region in column x and row y of a map.
    [[nodiscard]] Region at(size_t map, unsigned x, unsigned y) const;
    // The region at weights u and v of vertices 1 and 2 of one of the pair's triangles.
    [[nodiscard]] Region at(size_t map, Half half, float u, float v) const;
    // The bits that finding this region reads (docs/spec/bits-read.md).
    [[nodiscard]] unsigned bitsRead(size_t map, unsigned x, unsigned y) const;
    // A whole map.
    [[nodiscard]] Square decode(size_t map) const;

    // at(maps[k], halves[k], u[k], v[k]) into regions[k] for all k, in SIMD. All spans have one length.
    void lookup(std::span<const uint32_t> maps, std::span<const Half> halves, std::span<const float> u,
                std::span<const float> v, std::span<Region> regions) const;

  private:
    SquareReader(SquareFormat format, std::span<const uint8_t> bytes) : format_(format), bytes_(bytes) {}
    SquareFormat format_;
    std::span<const uint8_t> bytes_;
};

// A square as a raw map of side * side / 4 bytes; free regions become mixed.
FILIGREE_API void encodeRaw(const Square& square, std::span<uint8_t> block);

}  // namespace filigree::quadmap
