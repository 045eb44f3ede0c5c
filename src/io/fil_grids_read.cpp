#include "filigree/core/mapped_file.h"
#include "filigree/grid/check.h"
#include "filigree/io/fil_grids.h"

#include "io/fil_grids_attributes.h"
#include "io/fil_grids_layout.h"
#include "io/fil_grids_meta.h"
#include "io/fil_sections.h"
#include "io/words.h"

#include <algorithm>
#include <bit>

namespace filigree::io {
namespace {

constexpr std::initializer_list<FilKind> gridKinds{
    FilKind::meta,      FilKind::grids,   FilKind::nodes,   FilKind::offsets, FilKind::payload,
    FilKind::diagonals, FilKind::sources, FilKind::corners, FilKind::normals, FilKind::uvs};

bvh::Node unpackNode(const uint8_t* from) {
    bvh::Node node;
    for (size_t axis = 0; axis < 3; ++axis) {
        node.origin[axis] = std::bit_cast<float>(loadLe<uint32_t>(from + 4 * axis));
        node.exponent[axis] = static_cast<int8_t>(from[12 + axis]);
        std::copy_n(from + 32 + 8 * axis, 8, node.low[axis].begin());
        std::copy_n(from + 56 + 8 * axis, 8, node.high[axis].begin());
    }
    node.innerMask = from[15];
    node.firstChild = loadLe<uint32_t>(from + 16);
    node.firstLeaf = loadLe<uint32_t>(from + 20);
    node.leafMask = from[24];
    node.slotAxes = from[25];
    std::copy_n(from + 26, node.zeros.size(), node.zeros.begin());
    return node;
}

Result<std::vector<grid::VertexGrid>> unpackTable(std::span<const uint8_t> bytes) {
    std::vector<grid::VertexGrid> table(bytes.size() / filGridBytes);
    uint64_t vertices = 0;
    uint64_t quads = 0;
    for (size_t k = 0; k < table.size(); ++k) {
        const auto columns = loadLe<uint16_t>(&bytes[k * filGridBytes]);
        const auto rows = loadLe<uint16_t>(&bytes[k * filGridBytes + 2]);
        if (columns == 0 || rows == 0)
            return Error{ErrorKind::format, fmt::format("section grids: grid {} has {} x {} quads, expected "
                                                        "1 or more",
                                                        k, columns, rows)};
        table[k] = {columns + 1U, rows + 1U, vertices, quads};
        vertices += table[k].vertexCount();
        quads += table[k].quadCount();
    }
    return table;
}

Result<FilGridHead> gridHeadOf(FilSections& sections) {
    const auto meta = sections.take(FilKind::meta, 0, filMostMetaBytes);
    if (!meta) return meta.error();
    auto head = decodeGridMeta(*meta);
    if (!head) return head.error().within("section meta");
    return head;
}

Status readGridTable(FilSections& sections, const FilGridHead& head, FilGrids& file) {
    const uint64_t tableBytes = filGridBytes * head.grids;
    const auto table = sections.take(FilKind::grids, tableBytes, tableBytes);
    if (!table) return table.error();
    auto grids = unpackTable(*table);
    if (!grids) return grids.error();
    file.table = std::move(*grids);
    return {};
}

Status readNodes(FilSections& sections, const FilGridHead& head, grid::EncodedGrids& grids) {
    const auto nodes = sections.take(FilKind::nodes, 0, filNodeBytes * head.records);
    if (!nodes) return nodes.error();
    if (nodes->size() % filNodeBytes != 0)
        return Error{ErrorKind::format, fmt::format("section nodes: {} bytes, expected a multiple of {}",
                                                    nodes->size(), filNodeBytes)};
    grids.nodes.resize(nodes->size() / filNodeBytes);
    for (size_t k = 0; k < grids.nodes.size(); ++k) grids.nodes[k] = unpackNode(&(*nodes)[k * filNodeBytes]);
    return {};
}

Status readRecords(FilSections& sections, const FilGridHead& head, grid::EncodedGrids& grids) {
    grids.codec = head.codec;
    grids.lattice = head.lattice;
    grids.paper = head.paper;
    const auto offsets = sections.take(FilKind::offsets, 0, uint64_t{4} * head.records);
    if (!offsets) return offsets.error();
    const auto payload = sections.take(FilKind::payload, grid::EncodedGrids::recordSlack,
                                       filMostRecordBytes * head.records + grid::EncodedGrids::recordSlack);
    if (!payload) return payload.error();
    grids.offsets = unpackWords<uint32_t>(*offsets);
    grids.records.assign(payload->begin(), payload->end());
    if (offsets->size() % 4 == 0 && grids.leafCount() == head.records) return {};
    return Error{ErrorKind::format, fmt::format("section offsets: {} bytes for {} records, and payload {}",
                                                offsets->size(), head.records, payload->size())};
}

Result<FilGrids> openGrids(std::span<const uint8_t> bytes, const Executor& executor,
                           const FilReadOptions& options) {
    auto entries = readTable(bytes);
    if (!entries) return entries.error();
    std::vector<std::vector<uint8_t>> plain;
    FilSections sections(std::move(*entries), options.maxBytes, plain);
    const auto head = gridHeadOf(sections);
    if (!head) return head.error();
    Status status = sections.allowOnly(gridKinds);
    FilGrids file;
    file.asset = head->asset;
    file.looseTriangles = head->looseTriangles;
    if (status) status = readGridTable(sections, *head, file);
    if (status) status = readNodes(sections, *head, file.grids);
    if (status) status = readRecords(sections, *head, file.grids);
    if (status) status = grid::check(file.grids, executor);
    if (status) status = grid::checkPlaces(file.grids, file.table, file.looseTriangles);
    if (status) status = readGridAttributes(sections, head->looseVertices, file);
    if (!status) return status.error();
    return file;
}

}  // namespace

Result<FilGrids> readFilGrids(const std::filesystem::path& path, const Executor& executor,
                              const FilReadOptions& options) {
    const Result<MappedFile> mapped = MappedFile::open(path);
    if (!mapped) return mapped.error();
    return parseFilGrids(mapped->bytes(), path.string(), executor, options);
}

Result<FilGrids> parseFilGrids(std::span<const uint8_t> bytes, const std::string& name,
                               const Executor& executor, const FilReadOptions& options) {
    Result<FilGrids> file = openGrids(bytes, executor, options);
    if (!file) return file.error().within(name);
    return file;
}

std::optional<grid::Codec> gridsIn(const std::filesystem::path& path) {
    const auto mapped = MappedFile::open(path);
    return mapped ? gridsIn(mapped->bytes()) : std::nullopt;
}

std::optional<grid::Codec> gridsIn(std::span<const uint8_t> bytes) {
    auto table = readTable(bytes);
    if (!table) return std::nullopt;
    std::vector<std::vector<uint8_t>> plain;
    FilSections sections(std::move(*table), filMostMetaBytes, plain);
    const auto head = gridHeadOf(sections);
    if (!head) return std::nullopt;
    return head->codec;
}

}  // namespace filigree::io
