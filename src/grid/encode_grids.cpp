#include "filigree/grid/encode_grids.h"

#include "filigree/bvh/build.h"
#include "filigree/grid/cluster.h"
#include "filigree/grid/error.h"
#include "filigree/grid/tile.h"

#include "grid/cluster_box.h"
#include "grid/mesh_check.h"
#include "grid/record_spans.h"
#include "grid/snap_paper.h"
#include "grid/sub_grids.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

namespace filigree::grid {
namespace {

constexpr uint64_t mostRecordBytes = uint64_t{EncodedGrids::clusterBit} * EncodedGrids::recordUnit;
constexpr uint32_t mostTileGrids = 1U << 24;

// Records of a run of tiles or clusters, encoded on one thread.
struct RecordBlock {
    std::vector<uint8_t> bytes;
    std::vector<size_t> ends;  // of each record in `bytes`
    std::vector<Box> boxes;
    void close(const Box& box) {
        ends.push_back(bytes.size());
        boxes.push_back(box);
    }
};

void appendBlock(const RecordBlock& block, uint32_t kindBit, GridRecords& records) {
    size_t begin = 0;
    for (const size_t end : block.ends) {
        const uint64_t offset = (records.records.size() + begin) / EncodedGrids::recordUnit;
        records.offsets.push_back(static_cast<uint32_t>(offset) | kindBit);
        begin = end;
    }
    records.records.insert(records.records.end(), block.bytes.begin(), block.bytes.end());
    records.boxes.insert(records.boxes.end(), block.boxes.begin(), block.boxes.end());
}

// The inputs and outputs that all kinds of records share.
struct RecordWriter {
    const GridMesh& mesh;
    const Executor& executor;
    ProgressSink& progress;
    GridRecords& records;

    // encode(k, block) for records 0 to `count`, in runs of `grain` of which a few are held at once.
    void inBlocks(size_t count, size_t grain, uint32_t kindBit,
                  const std::function<uint64_t(size_t, RecordBlock&)>& encode) const {
        const size_t blocksAtOnce = size_t{64} * executor.concurrency();
        for (size_t first = 0; first < count && !progress.cancelled(); first += grain * blocksAtOnce) {
            const size_t left = std::min(count - first, grain * blocksAtOnce);
            std::vector<RecordBlock> blocks((left + grain - 1) / grain);
            executor.parallelFor(blocks.size(), 1, [&](size_t begin, size_t end) {
                for (size_t b = begin; b < end; ++b) {
                    uint64_t triangles = 0;
                    for (size_t k = b * grain; k < std::min(left, (b + 1) * grain); ++k)
                        triangles += encode(first + k, blocks[b]);
                    progress.advance(triangles);
                }
            });
            for (const RecordBlock& block : blocks) appendBlock(block, kindBit, records);
        }
    }

    // As clusterBox() of their record, which keeps their lattice points.
    [[nodiscard]] Box boxOfLoose(uint32_t first, uint32_t count) const {
        Box box;
        for (uint32_t t = first; t < first + count; ++t) {
            for (const uint32_t vertex : mesh.looseTriangles[t]) {
                const LatticePoint p = records.lattice.pointAt(mesh.looseVertices[vertex]);
                box.extend(leafCorner(p, records.codec, records.lattice));
            }
        }
        return box;
    }

    void tiles() const {
        std::vector<TilePlace> places;
        for (uint32_t k = 0; k < mesh.grids.size(); ++k) {
            const auto some = tilesOf(mesh.grids[k], k);
            places.insert(places.end(), some.begin(), some.end());
        }
        inBlocks(places.size(), 16, 0, [&](size_t k, RecordBlock& block) {
            const Tile tile = snapTile(mesh, records.lattice, places[k]);
            encodeTile(tile, block.bytes);
            block.close(tile.box());
            return uint64_t{2} * places[k].columns * places[k].rows;
        });
    }

    void clusters(std::span<const uint32_t> starts) const {
        if (starts.size() < 2) return;
        inBlocks(starts.size() - 1, 64, EncodedGrids::clusterBit, [&](size_t k, RecordBlock& block) {
            const uint32_t count = starts[k + 1] - starts[k];
            appendCluster(mesh, starts[k], count, records.lattice, block.bytes);
            block.close(boxOfLoose(starts[k], count));
            return uint64_t{count};
        });
    }

    // `vertices` in the layout of GridMesh::vertices.
    void subGrids(std::span<const PaperPlace> places, std::span<const Vec3> vertices) const {
        records.records.resize(places.size() * paperBytes);
        records.boxes.resize(places.size());
        records.offsets.resize(places.size());
        executor.parallelFor(places.size(), 256, [&](size_t begin, size_t end) {
            uint64_t triangles = 0;
            for (size_t k = begin; k < end && !progress.cancelled(); ++k) {
                const PaperPlace& place = places[k];
                const auto record = encodePaper(
                    place, subGridVertices(vertices, mesh.grids[place.grid], place), records.paper);
                std::ranges::copy(record, records.records.begin() + static_cast<ptrdiff_t>(k * paperBytes));
                records.boxes[k] = boxOf(decodePaper(record.data(), records.paper), place);
                records.offsets[k] = static_cast<uint32_t>(k * paperBytes / EncodedGrids::recordUnit);
                triangles += uint64_t{2} * place.columns * place.rows;
            }
            progress.advance(triangles);
        });
    }
};

Status checkDiagonals(const GridMesh& mesh) {
    if (mesh.diagonals.empty()) return {};
    for (size_t k = 0; k < mesh.grids.size(); ++k) {
        const auto begin = mesh.diagonals.begin() + static_cast<ptrdiff_t>(mesh.grids[k].firstQuad);
        const auto end = begin + static_cast<ptrdiff_t>(mesh.grids[k].quadCount());
        if (std::all_of(begin, end, [&](Diagonal d) { return d == *begin; })) continue;
        return Error{ErrorKind::unsupported,
                     fmt::format("grid {}: its quads have different diagonals, which codec paper cannot "
                                 "hold; convert with uniform diagonals, or use codec lattice",
                                 k)};
    }
    return {};
}

Status checkLattice(const Box& bounds, const Lattice& lattice) {
    for (size_t axis = 0; axis < 3; ++axis) {
        const double step = lattice.step[axis];
        const double low = (double{bounds.low[axis]} - lattice.origin[axis]) / step;
        const double high = (double{bounds.high[axis]} - lattice.origin[axis]) / step;
        if (low > -0.5 && high < latticeLimit - 0.5) continue;
        const double extent = double{bounds.high[axis]} - double{bounds.low[axis]};
        return Error{ErrorKind::format,
                     fmt::format("a step of {} puts {} = {} at lattice point {:.0f}, expected 0 to {}; a "
                                 "step of {:.3g} would fit",
                                 step, "xyz"[axis], low > -0.5 ? bounds.high[axis] : bounds.low[axis],
                                 low > -0.5 ? high : low, latticeLimit - 1, extent / (latticeLimit - 2))};
    }
    return {};
}

Status checkMesh(const GridMesh& mesh, const EncodeOptions& options) {
    if (mesh.triangleCount() == 0) return Error{ErrorKind::format, "the mesh has no triangles"};
    if (options.codec == Codec::paper) return checkDiagonals(mesh);
    if (mesh.grids.size() >= mostTileGrids) {
        return Error{ErrorKind::limit,
                     fmt::format("{} grids, codec lattice holds {}", mesh.grids.size(), mostTileGrids - 1)};
    }
    return checkLattice(boundsOf(mesh), options.lattice);
}

// Codec, lattice and code of displacements.
Result<GridRecords> frameOf(const GridMesh& mesh, const EncodeOptions& options) {
    GridRecords records;
    records.codec = options.codec;
    records.lattice = options.lattice;
    if (options.codec == Codec::lattice) return records;
    const Result<Lattice> fine = fineLattice(mesh);
    if (!fine) return fine.error();
    records.lattice = *fine;
    records.paper = PaperCode::forDiagonal(options.displacement, boundsOf(mesh).diagonal());
    return records;
}

void encodeSubGrids(const RecordWriter& writer, bool snap) {
    const std::vector<PaperPlace> places = subGridsOf(writer.mesh);
    if (!snap) return writer.subGrids(places, writer.mesh.vertices);
    const SnappedPaper snapped =
        snapPaper(writer.mesh, places, writer.records.paper, writer.records.lattice, writer.executor);
    writer.subGrids(snapped.places, snapped.vertices);
}

}  // namespace

Result<Lattice> fineLattice(const GridMesh& mesh) {
    const Box bounds = boundsOf(mesh);
    if (bounds.empty()) return Error{ErrorKind::format, "the mesh has no vertices"};
    double greatest = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
        const double extent = double{bounds.high[axis]} - double{bounds.low[axis]};
        greatest = std::max(
            {greatest, extent, std::fabs(double{bounds.low[axis]}), std::fabs(double{bounds.high[axis]})});
    }
    // One bit to spare, for an origin that is a multiple of the step.
    const double step = greatest > 0 ? std::ldexp(1.0, std::ilogb(greatest) + 2 - 24) : 1;
    Lattice lattice;
    for (size_t axis = 0; axis < 3; ++axis) {
        lattice.step[axis] = step;
        lattice.origin[axis] = std::floor(double{bounds.low[axis]} / step) * step;
    }
    return lattice;
}

Result<GridRecords> encodeRecords(GridMesh& mesh, const EncodeOptions& options, const Executor& executor,
                                  ProgressSink& progress) {
    if (const Status status = checkTables(mesh, executor); !status) return status.error();
    if (const Status status = checkMesh(mesh, options); !status) return status.error();
    Result<GridRecords> records = frameOf(mesh, options);
    if (!records) return records.error();
    progress.begin("encode", mesh.triangleCount(), "triangles");
    const std::vector<uint32_t> starts = clusterLoose(mesh, executor);
    const RecordWriter writer{mesh, executor, progress, *records};
    if (options.codec == Codec::paper)
        encodeSubGrids(writer, options.snap);
    else
        writer.tiles();
    writer.clusters(starts);
    progress.end();
    if (progress.cancelled()) return Error{ErrorKind::cancelled, "stopped while encoding"};
    if (records->records.size() > mostRecordBytes) {
        return Error{ErrorKind::limit, fmt::format("{} bytes of records, a file holds at most {}",
                                                   records->records.size(), mostRecordBytes)};
    }
    return records;
}

EncodedGrids buildGrids(GridRecords records, const Executor& executor) {
    return std::move(*buildGrids(std::move(records), executor, silentProgress()));
}

Result<EncodedGrids> buildGrids(GridRecords records, const Executor& executor, ProgressSink& progress) {
    Result<bvh::Bvh> bvh = bvh::build(records.boxes, executor, progress);
    if (!bvh) return bvh.error();
    EncodedGrids grids;
    grids.codec = records.codec;
    grids.lattice = records.lattice;
    grids.paper = records.paper;
    grids.nodes = std::move(bvh->nodes);
    const RecordSpans from(records.offsets, records.records.size());
    grids.records.reserve(records.records.size() + EncodedGrids::recordSlack);
    grids.offsets.reserve(records.offsets.size());
    for (const uint32_t leaf : bvh->order) {
        const auto record =
            std::span<const uint8_t>(records.records).subspan(from.begin(leaf), from.size(leaf));
        const auto offset = static_cast<uint32_t>(grids.records.size() / EncodedGrids::recordUnit);
        grids.offsets.push_back(offset | (records.offsets[leaf] & EncodedGrids::clusterBit));
        grids.records.insert(grids.records.end(), record.begin(), record.end());
    }
    grids.records.resize(grids.records.size() + EncodedGrids::recordSlack);
    const bool hasClusters = std::ranges::any_of(
        grids.offsets, [](uint32_t offset) { return (offset & EncodedGrids::clusterBit) != 0; });
    if (grids.codec == Codec::paper && !hasClusters) grids.offsets = {};
    return grids;
}

Result<EncodedGrids> encodeGrids(GridMesh& mesh, const EncodeOptions& options, const Executor& executor,
                                 ProgressSink& progress) {
    Result<GridRecords> records = encodeRecords(mesh, options, executor, progress);
    if (!records) return records.error();
    return buildGrids(std::move(*records), executor, progress);
}

}  // namespace filigree::grid
