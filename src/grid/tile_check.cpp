#include "filigree/grid/tile.h"

#include "grid/tile_boxes.h"
#include "grid/tile_layout.h"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace filigree::grid {
namespace {

Error tileError(std::string message) {
    return {ErrorKind::format, std::move(message)};
}

template <class Visit>
void forEachTileBlock(const TileHeader& head, const Visit& visit) {
    for (unsigned j = 0; j < head.blockRows(); ++j)
        for (unsigned i = 0; i < head.blockColumns(); ++i) visit(i, j, j * head.blockColumns() + i);
}

Status checkTileRanges(const TileHeader& head) {
    for (unsigned k = 0; k < 3; ++k) {
        unsigned widest = std::max(head.cornerWidth[k], head.coarseWidth[k]);
        for (const unsigned width : head.width[k]) widest = std::max(widest, width);
        if (widest > widestField)
            return tileError(
                fmt::format("a field of a tile is {} bits wide, expected at most {}", widest, widestField));
        if (head.reach[k] >> 3 > widestReachShift)
            return tileError(fmt::format("a tile's reach is shifted by {} bits, expected at most {}",
                                         head.reach[k] >> 3, widestReachShift));
    }
    if (head.dominant > 2) return tileError("a tile's dominant axis is number 3, expected 0 to 2");
    if (head.diagonals > TileDiagonals::mixed)
        return tileError("a tile stores its diagonals as 3, expected 0 to 2");
    return {};
}

Status checkTileReserved(const uint8_t* record) {
    uint32_t reserved = loadLe<uint32_t>(record + 4) >> 31;
    for (unsigned k = 5; k < 9; ++k) reserved |= loadLe<uint32_t>(record + size_t{4} * k) >> 30;
    if (reserved != 0) return tileError("a reserved bit of a tile's header is set");
    return {};
}

Status checkTileDiagonals(const uint8_t* record, const TileHeader& head) {
    if (head.diagonals != TileDiagonals::mixed) return {};
    uint32_t surplus = 0;
    forEachTileBlock(head, [&](unsigned i, unsigned j, unsigned block) {
        const uint32_t row = (1U << head.columnsOf(i)) - 1;
        const uint32_t quads = 0x1111U * row & ((1U << 4 * head.rowsOf(j)) - 1);
        surplus |= loadLe<uint16_t>(record + tileParts(head).diagonals + size_t{2} * block) & ~quads;
    });
    if (surplus != 0) return tileError("a tile has a diagonal of a quad that is not there");
    return {};
}

Status checkTileEnd(const uint8_t* record, const TileHeader& head, size_t bytes) {
    for (size_t bit = 8 * tileParts(head).bits + bitStringSize(record, head); bit < 8 * bytes; ++bit)
        if ((record[bit / 8] >> bit % 8 & 1) != 0)
            return tileError("a bit behind the last field of a tile is set");
    return {};
}

bool containsBox(const LatticeBox& outer, const LatticeBox& inner) {
    for (unsigned k = 0; k < 3; ++k)
        if (outer.low[k] > inner.low[k] || outer.high[k] < inner.high[k]) return false;
    return true;
}

Status checkBlockBoxes(const uint8_t* record, const TileHeader& head) {
    const Tile tile = decodeTile(record);
    Status status;
    forEachTileBlock(head, [&](unsigned i, unsigned j, unsigned block) {
        const LatticeBox box = widenedBox(cornerBox(tile, head, i, j), head, record[tileHeaderBytes + block]);
        if (status.ok() && !containsBox(box, vertexBox(tile, head, i, j)))
            status = tileError(fmt::format("block {} of a tile reaches out of its box", block));
    });
    return status;
}

}  // namespace

Result<size_t> checkTile(std::span<const uint8_t> bytes) {
    const auto tooShort = [&](size_t needed) {
        return tileError(fmt::format("a tile needs {} bytes, {} are left", needed, bytes.size()));
    };
    if (bytes.size() < tileHeaderBytes) return tooShort(tileHeaderBytes);
    const uint8_t* record = bytes.data();
    const TileHeader head = loadTileHeader(record);
    for (const Status& status : {checkTileRanges(head), checkTileReserved(record)})
        if (!status) return status.error();
    if (bytes.size() < tileParts(head).bits) return tooShort(tileParts(head).bits);
    const size_t size = tileBytes(record);
    if (bytes.size() < size) return tooShort(size);
    for (const Status& status :
         {checkTileDiagonals(record, head), checkTileEnd(record, head, size), checkBlockBoxes(record, head)})
        if (!status) return status.error();
    return size;
}

}  // namespace filigree::grid
