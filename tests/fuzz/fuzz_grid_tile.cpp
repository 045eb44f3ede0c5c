// Any bytes as a tile: what is accepted decodes within the lattice, encodes again to a record of the same
// tile, and that the same way each time. The same bytes as coordinates: whatever they are, the tile comes
// back.
#include "filigree/grid/tile.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace {

using namespace filigree;
using namespace filigree::grid;

void fail(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

void encodeAndDecode(const Tile& tile) {
    std::vector<uint8_t> record;
    encodeTile(tile, record);
    std::vector<uint8_t> again;
    encodeTile(tile, again);
    if (record != again) fail("two records of one tile differ");
    const auto size = checkTile(record);
    if (!size || *size != record.size()) fail("a record of ours is refused");
    if (!(decodeTile(record.data()) == tile)) fail("a tile changes");
}

void decode(const uint8_t* data, size_t size) {
    // Its own allocation, so that a read behind it is seen.
    const auto bytes = std::make_unique<uint8_t[]>(size);
    std::copy_n(data, size, bytes.get());
    const auto length = checkTile({bytes.get(), size});
    if (!length) return;
    if (*length > size || *length % 8 != 0 || *length != tileBytes(bytes.get())) fail("a size is wrong");
    const Tile tile = decodeTile(bytes.get());
    for (const LatticePoint& point : tile.points)
        for (const int32_t coordinate : point)
            if (coordinate < 0 || coordinate >= latticeLimit) fail("a vertex lies outside the lattice");
    encodeAndDecode(tile);
}

void encode(const uint8_t* data, size_t size) {
    Tile tile;
    tile.place.columns = 1 + data[0] % 16;
    tile.place.rows = 1 + data[0] / 16;
    const unsigned shift = data[1] % 24;
    const auto number = [&](size_t k) {
        const size_t at = 2 + 3 * k % (size - 4);
        return (data[at] | data[at + 1] << 8 | data[at + 2] << 16) >> shift;
    };
    size_t k = 0;
    for (unsigned row = 0; row <= tile.place.rows; ++row)
        for (unsigned column = 0; column <= tile.place.columns; ++column)
            for (int32_t& coordinate : tile.at(column, row)) coordinate = number(k++);
    for (unsigned row = 0; row < tile.place.rows; ++row)
        for (unsigned column = 0; column < tile.place.columns; ++column)
            tile.bd.set(row * 16 + column, (data[1] & 0x20) != 0 && number(k++) % 2 != 0);
    encodeAndDecode(tile);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size < 8) return 0;
    decode(data, size);
    encode(data, size);
    return 0;
}
