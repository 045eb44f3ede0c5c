#include "filigree/quadmap/reader.h"

#include "filigree/quadmap/vq2.h"
#include "filigree/quadmap/vq4.h"

#include "quadmap/lookup.h"

#include <array>

#include <fmt/format.h>

namespace filigree::quadmap {
namespace {

struct FormatFacts {
    std::string_view name;
    unsigned side;
    size_t bytes;
};
constexpr std::array<FormatFacts, squareFormatCount> facts{{
    {"vq2", vq2Side, vq2Bytes},
    {"vq2+", vq2Side, vq2Bytes},
    {"vq4", vq4Side, vq4Bytes},
    {"vq4+", vq4Side, vq4Bytes},
    {"raw16", 16, 64},
    {"raw32", 32, 256},
}};
constexpr const FormatFacts& factsOf(SquareFormat format) {
    return facts[static_cast<size_t>(format)];
}

constexpr bool isRaw(SquareFormat format) {
    return format == SquareFormat::raw16 || format == SquareFormat::raw32;
}

Region rawRegion(std::span<const uint8_t> block, unsigned side, unsigned x, unsigned y) {
    const unsigned place = y * side + x;
    return static_cast<Region>(block[place / 4] >> (2 * (place % 4)) & 3);
}

}  // namespace

std::string_view nameOf(SquareFormat format) {
    return factsOf(format).name;
}
unsigned sideOf(SquareFormat format) {
    return factsOf(format).side;
}
size_t blockBytesOf(SquareFormat format) {
    return factsOf(format).bytes;
}

Result<SquareReader> SquareReader::open(SquareFormat format, std::span<const uint8_t> bytes) {
    const FormatFacts& fact = factsOf(format);
    if (bytes.size() % fact.bytes != 0) {
        return Error{ErrorKind::format, fmt::format("{} maps: found {} bytes, expected a multiple of {}",
                                                    fact.name, bytes.size(), fact.bytes)};
    }
    for (size_t k = 0; isRaw(format) && k < bytes.size(); ++k) {
        if ((bytes[k] & bytes[k] >> 1 & 0x55) == 0) continue;
        return Error{ErrorKind::format,
                     fmt::format("{} map {}: byte {} holds a region of value 3, expected 0 to 2", fact.name,
                                 k / fact.bytes, k % fact.bytes)};
    }
    return SquareReader(format, bytes);
}

Region SquareReader::at(size_t map, unsigned x, unsigned y) const {
    assert(map < mapCount());
    const std::span<const uint8_t> bytes = block(map);
    switch (format_) {
        case SquareFormat::vq2:
            return vq2Region(Vq2View(bytes), x, y);
        case SquareFormat::vq2Plus:
            return vq2PlusRegion(Vq2View(bytes), x, y);
        case SquareFormat::vq4:
            return vq4Region(Vq4View(bytes), Vq4Layout::vq4, x, y);
        case SquareFormat::vq4Plus:
            return vq4Region(Vq4View(bytes), Vq4Layout::vq4Plus, x, y);
        case SquareFormat::raw16:
        case SquareFormat::raw32:
            break;
    }
    return rawRegion(bytes, sideOf(format_), x, y);
}

Region SquareReader::at(size_t map, Half half, float u, float v) const {
    const SquarePoint point = pointInSquare(half, u, v);
    return at(map, regionAlong(point.x, sideOf(format_)), regionAlong(point.y, sideOf(format_)));
}

unsigned SquareReader::bitsRead(size_t map, unsigned x, unsigned y) const {
    switch (format_) {
        case SquareFormat::vq2:
            return vq2BitsRead(Vq2View(block(map)), x, y);
        case SquareFormat::vq2Plus:
            return vq2PlusBitsRead(Vq2View(block(map)), x, y);
        case SquareFormat::vq4:
            return vq4BitsRead(Vq4View(block(map)), Vq4Layout::vq4, x, y);
        case SquareFormat::vq4Plus:
            return vq4BitsRead(Vq4View(block(map)), Vq4Layout::vq4Plus, x, y);
        case SquareFormat::raw16:
        case SquareFormat::raw32:
            break;
    }
    return 2;
}

Square SquareReader::decode(size_t map) const {
    Square square(sideOf(format_));
    for (unsigned y = 0; y < square.side; ++y) {
        for (unsigned x = 0; x < square.side; ++x) square.at(x, y) = at(map, x, y);
    }
    return square;
}

void SquareReader::lookup(std::span<const uint32_t> maps, std::span<const Half> halves,
                          std::span<const float> u, std::span<const float> v,
                          std::span<Region> regions) const {
    assert(halves.size() == maps.size() && u.size() == maps.size() && v.size() == maps.size() &&
           regions.size() == maps.size());
    if (bytes_.size() >= INT32_MAX) {
        for (size_t k = 0; k < maps.size(); ++k) regions[k] = at(maps[k], halves[k], u[k], v[k]);
        return;
    }
    lookupSquares(format_, bytes_.data(), {maps, halves, u, v}, regions);
}

void encodeRaw(const Square& square, std::span<uint8_t> block) {
    assert(block.size() == square.regions.size() / 4);
    std::ranges::fill(block, uint8_t{0});
    for (size_t k = 0; k < square.regions.size(); ++k) {
        const Region region = isKnown(square.regions[k]) ? square.regions[k] : Region::mixed;
        block[k / 4] = static_cast<uint8_t>(block[k / 4] | static_cast<unsigned>(region) << (2 * (k % 4)));
    }
}

}  // namespace filigree::quadmap
