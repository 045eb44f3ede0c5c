#include "jobs/cell_map.h"

#include "filigree/micromap/quadtree.h"

#include <algorithm>
#include <span>

namespace filigree::jobs {
namespace {

// The children of a node, whose bit that says so is taken, `height` levels above the finest.
void writeNode(BitReader& stream, unsigned height, report::CellMap& map) {
    if (height == 1) {
        map.finest.push_back(static_cast<uint8_t>(stream.take(8)));
        return;
    }
    const size_t node = map.inner.size();
    map.inner.insert(map.inner.end(), {0, 0});
    for (unsigned k = 0; k < 4; ++k) {
        if (stream.takeBit()) {
            map.inner[node] = static_cast<uint8_t>(map.inner[node] | (1U << k));
            writeNode(stream, height - 1, map);
        } else {
            map.inner[node + 1] = static_cast<uint8_t>(map.inner[node + 1] | (stream.take(2) << (2 * k)));
        }
    }
}

void writeTree(const micromap::QuadtreeView& tree, report::CellMap& map) {
    if (tree.level == 0) return;
    BitReader stream(tree.words, tree.bits);
    if (stream.takeBit()) writeNode(stream, tree.level, map);
}

}  // namespace

report::CellMap cellMap(const micromap::FlatSet& set, uint32_t index, unsigned mostLevel) {
    const micromap::Record& record = set.records[index];
    const uint64_t bytes = micromap::flatBytes(record.level, record.format);
    const auto flat = std::span(set.data).subspan(record.byteOffset, bytes);
    const auto tree = micromap::quadtreeFromFlat(flat, record.level, record.format);
    const auto counts = micromap::countStates(tree.view());
    report::CellMap map;
    map.record = index;
    map.storedLevel = record.level;
    map.level = std::min<unsigned>(record.level, mostLevel);
    map.states = record.format == micromap::Format::twoState ? 2 : 4;
    map.bytes = bytes + micromap::recordBytes;
    std::copy_n(counts.of, 4, map.cells.begin());
    if (map.level == map.storedLevel) {
        writeTree(tree.view(), map);
    } else {
        writeTree(micromap::coarsened(tree.view(), map.level, record.format).view(), map);
    }
    return map;
}

}  // namespace filigree::jobs
