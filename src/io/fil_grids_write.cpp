#include "filigree/io/fil_grids.h"

#include "io/fil_grids_layout.h"
#include "io/fil_grids_meta.h"
#include "io/fil_write.h"
#include "io/words.h"

#include <algorithm>
#include <bit>

namespace filigree::io {
namespace {

// Two lists, one after the other.
template <class T, class U>
std::vector<uint8_t> packLists(const std::vector<T>& first, const std::vector<U>& second) {
    std::vector<uint8_t> bytes;
    packWords(std::span<const T>(first), bytes);
    packWords(std::span<const U>(second), bytes);
    return bytes;
}
template <class T>
std::vector<uint8_t> packList(const std::vector<T>& list) {
    return packLists(list, std::vector<T>());
}

void packNode(const bvh::Node& node, uint8_t* to) {
    for (size_t axis = 0; axis < 3; ++axis) {
        storeLe(to + 4 * axis, std::bit_cast<uint32_t>(node.origin[axis]));
        to[12 + axis] = static_cast<uint8_t>(node.exponent[axis]);
        std::ranges::copy(node.low[axis], to + 32 + 8 * axis);
        std::ranges::copy(node.high[axis], to + 56 + 8 * axis);
    }
    to[15] = node.innerMask;
    storeLe(to + 16, node.firstChild);
    storeLe(to + 20, node.firstLeaf);
    to[24] = node.leafMask;
    to[25] = node.slotAxes;
    std::ranges::copy(node.zeros, to + 26);
}
std::vector<uint8_t> packNodes(std::span<const bvh::Node> nodes) {
    std::vector<uint8_t> bytes(nodes.size() * filNodeBytes);
    for (size_t k = 0; k < nodes.size(); ++k) packNode(nodes[k], &bytes[k * filNodeBytes]);
    return bytes;
}

std::vector<uint8_t> packTable(std::span<const grid::VertexGrid> table) {
    std::vector<uint8_t> bytes(table.size() * filGridBytes);
    for (size_t k = 0; k < table.size(); ++k) {
        storeLe(&bytes[k * filGridBytes], static_cast<uint16_t>(table[k].columns - 1));
        storeLe(&bytes[k * filGridBytes + 2], static_cast<uint16_t>(table[k].rows - 1));
    }
    return bytes;
}

std::vector<uint8_t> packDiagonals(std::span<const grid::Diagonal> diagonals) {
    std::vector<uint8_t> bytes((diagonals.size() + 7) / 8);
    for (size_t k = 0; k < diagonals.size(); ++k) {
        const unsigned bit = diagonals[k] == grid::Diagonal::bd ? 1 : 0;
        bytes[k / 8] = static_cast<uint8_t>(bytes[k / 8] | bit << (k % 8));
    }
    return bytes;
}
uint32_t looseVertexCount(const grid::GridAttributes& attributes) {
    return static_cast<uint32_t>(std::max(attributes.looseNormals.size(), attributes.looseUvs.size()));
}

FilSectionList sectionsOf(const FilGrids& file) {
    const auto& attributes = file.attributes;
    FilSectionList sections;
    const auto addSome = [&](FilKind kind, std::vector<uint8_t> bytes) {
        if (!bytes.empty()) sections.add(kind, std::move(bytes));
    };
    sections.add(FilKind::meta,
                 encodeGridMeta({file.asset, file.grids.codec, file.grids.lattice, file.grids.paper,
                                 static_cast<uint32_t>(file.grids.leafCount()),
                                 static_cast<uint32_t>(file.table.size()), file.looseTriangles,
                                 looseVertexCount(attributes)}));
    sections.add(FilKind::grids, packTable(file.table));
    sections.add(FilKind::nodes, packNodes(file.grids.nodes));
    sections.add(FilKind::offsets, packList(file.grids.offsets));
    sections.view(FilKind::payload, file.grids.records);
    addSome(FilKind::diagonals, packDiagonals(attributes.diagonals));
    addSome(FilKind::sources, packLists(attributes.quadSources, attributes.looseSources));
    addSome(FilKind::corners, packList(attributes.looseTriangles));
    addSome(FilKind::normals, packLists(attributes.normals, attributes.looseNormals));
    addSome(FilKind::uvs, packLists(attributes.uvs, attributes.looseUvs));
    return sections;
}

}  // namespace

Result<uint64_t> writeFilGrids(const std::filesystem::path& path, const FilGrids& grids, bool zstd) {
    return sectionsOf(grids).write(path, zstd);
}

std::vector<uint8_t> encodeFilGrids(const FilGrids& grids, bool zstd) {
    return sectionsOf(grids).join(zstd);
}

}  // namespace filigree::io
