#include "filigree/grid/check.h"

#include "filigree/bvh/build.h"
#include "filigree/core/stage.h"
#include "filigree/grid/cluster.h"
#include "filigree/grid/tile.h"

#include "grid/record_box.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>

#include <fmt/format.h>

namespace filigree::grid {
namespace {

constexpr uint64_t mostQuads = 256;  // of a record

template <class... Args>
Error brokenGrids(fmt::format_string<Args...> format, Args&&... args) {
    return {ErrorKind::format, fmt::format(format, std::forward<Args>(args)...)};
}

Status checkLatticeNumbers(const Lattice& lattice) {
    for (size_t axis = 0; axis < 3; ++axis) {
        const double step = lattice.step[axis];
        const double origin = lattice.origin[axis];
        if (!(step > 0) || !std::isfinite(step))
            return brokenGrids("lattice: the step along {} is {}, expected above 0", "xyz"[axis], step);
        // Every point is a float.
        if (std::fabs(origin) + step * latticeLimit < 1e38) continue;
        return brokenGrids("lattice: {} from {} on leaves what a float holds", "xyz"[axis], origin);
    }
    return {};
}

Status checkOffsets(const EncodedGrids& grids) {
    if (grids.records.size() < EncodedGrids::recordSlack)
        return brokenGrids("records: {} bytes, expected at least {}", grids.records.size(),
                           EncodedGrids::recordSlack);
    const auto slack = std::span(grids.records).last(EncodedGrids::recordSlack);
    if (!std::ranges::all_of(slack, [](uint8_t byte) { return byte == 0; }))
        return brokenGrids("records: the last {} bytes are not zero", slack.size());
    const size_t bytes = grids.records.size() - slack.size();
    if (grids.offsets.empty()) {
        if (grids.codec == Codec::paper && bytes > 0 && bytes % paperBytes == 0) return {};
        return brokenGrids("records: {} bytes without offsets, expected sub-grids of {} each", bytes,
                           paperBytes);
    }
    uint64_t least = 0;
    for (size_t k = 0; k < grids.offsets.size(); ++k) {
        const uint64_t offset =
            uint64_t{grids.offsets[k] & ~EncodedGrids::clusterBit} * EncodedGrids::recordUnit;
        const bool inOrder = k == 0 ? offset == 0 : offset >= least;
        if (!inOrder || offset >= bytes)
            return brokenGrids("record {}: begins at byte {}, expected {} to {}", k, offset,
                               k == 0 ? 0 : least, k == 0 ? 0 : bytes - 1);
        least = offset + EncodedGrids::recordUnit;
    }
    return {};
}

// Checks one record after another and gives the box of what it decodes to.
class RecordCheck {
  public:
    explicit RecordCheck(const EncodedGrids& grids) : grids_(grids), spans_(grids) {}

    [[nodiscard]] Result<Box> boxOf(size_t k) const {
        const auto record = std::span(grids_.records).subspan(spans_.begin(k), spans_.size(k));
        const Status sound = spans_.isCluster(k) ? checkSize(checkCluster(record, UINT32_MAX), record.size())
                             : grids_.codec == Codec::paper ? checkSubGrid(record)
                                                            : checkSize(checkTile(record), record.size());
        if (!sound) return sound.error().within(fmt::format("record {}", k));
        return boxOfRecord(grids_, spans_, k);
    }

  private:
    static Status checkSize(const Result<size_t>& found, size_t expected) {
        if (!found) return found.error();
        if (*found == expected) return {};
        return brokenGrids("{} bytes, the offsets give it {}", *found, expected);
    }
    [[nodiscard]] Status checkSubGrid(std::span<const uint8_t> record) const {
        if (record.size() != paperBytes)
            return brokenGrids("sub-grid of {} bytes, expected {}", record.size(), paperBytes);
        return checkPaper(record.first<paperBytes>(), grids_.paper);
    }

    const EncodedGrids& grids_;
    RecordSpans spans_;
};

bool contains(const Box& outer, const Box& inner) {
    for (size_t axis = 0; axis < 3; ++axis) {
        if (!(outer.low[axis] <= inner.low[axis] && inner.high[axis] <= outer.high[axis])) return false;
    }
    return true;
}

// Gives the box around all leaves below a node, found by its children's, which stand behind it.
class BoxCheck {
  public:
    BoxCheck(std::span<const bvh::Node> nodes, std::span<const Box> leaves)
        : nodes_(nodes), leaves_(leaves), inside_(nodes.size()) {}

    Status run() {
        for (size_t n = nodes_.size(); n-- > 0;) {
            if (const Status status = checkNode(n); !status) return status;
        }
        return {};
    }

  private:
    Status checkNode(size_t n) {
        const bvh::Node& node = nodes_[n];
        uint32_t inner = node.firstChild;
        uint32_t leaf = node.firstLeaf;
        for (size_t k = 0; k < bvh::width; ++k) {
            const bool isInner = (node.innerMask >> k & 1) != 0;
            if (!node.hasChild(k)) continue;
            const Box& box = isInner ? inside_[inner++] : leaves_[leaf++];
            if (!contains(node.childBox(k), box))
                return brokenGrids("node {}: child {} reaches out of its box", n, k);
            inside_[n].extend(box);
        }
        return {};
    }

    std::span<const bvh::Node> nodes_;
    std::span<const Box> leaves_;
    std::vector<Box> inside_;
};

// Runs body(k) -> Status for all k and gives the failure of least k.
template <class Body>
Status firstFailure(size_t count, const Stage& stage, const Body& body) {
    std::mutex mutex;
    size_t worst = count;
    Status failure;
    stage.parallelFor(count, 256, [&](size_t begin, size_t end) {
        stage.advance(end - begin);
        for (size_t k = begin; k < end; ++k) {
            const Status status = body(k);
            if (status) continue;
            const std::scoped_lock lock(mutex);
            if (k >= worst) return;
            worst = k;
            failure = status;
            return;
        }
    });
    return failure;
}

// Which quads of a grid a record covers.
struct QuadRange {
    uint32_t grid = 0;
    unsigned column = 0;
    unsigned row = 0;
    unsigned columns = 0;
    unsigned rows = 0;
    unsigned gridColumns = 0;  // quads
    unsigned gridRows = 0;
};

// Marks quads and loose triangles, each at most once.
class Coverage {
  public:
    Coverage(std::span<const VertexGrid> table, uint32_t looseTriangles)
        : table_(table),
          quads_(table.empty() ? 0 : table.back().firstQuad + table.back().quadCount()),
          loose_(looseTriangles) {}

    Status markQuads(const QuadRange& range) {
        if (range.grid >= table_.size())
            return brokenGrids("grid {}, expected below {}", range.grid, table_.size());
        const VertexGrid& grid = table_[range.grid];
        if (range.gridColumns != grid.columns - 1 || range.gridRows != grid.rows - 1)
            return brokenGrids("grid {} has {} x {} quads, expected {} x {}", range.grid, range.gridColumns,
                               range.gridRows, grid.columns - 1, grid.rows - 1);
        if (range.column + range.columns > range.gridColumns || range.row + range.rows > range.gridRows)
            return brokenGrids("{} x {} quads at ({}, {}) leave grid {}", range.columns, range.rows,
                               range.column, range.row, range.grid);
        for (unsigned row = range.row; row < range.row + range.rows; ++row) {
            const uint64_t first = grid.firstQuad + uint64_t{row} * (grid.columns - 1) + range.column;
            for (uint64_t quad = first; quad < first + range.columns; ++quad) {
                if (quads_[quad]) return brokenGrids("quad {} stands in two records", quad);
                quads_[quad] = true;
            }
        }
        return {};
    }

    Status markLoose(uint32_t first, uint32_t count) {
        if (uint64_t{first} + count > loose_.size())
            return brokenGrids("loose triangles {} to {}, expected below {}", first,
                               uint64_t{first} + count - 1, loose_.size());
        for (uint32_t t = first; t < first + count; ++t) {
            if (loose_[t]) return brokenGrids("loose triangle {} stands in two records", t);
            loose_[t] = true;
        }
        return {};
    }

    [[nodiscard]] Status everything() const {
        if (const auto quad = std::ranges::find(quads_, false); quad != quads_.end())
            return brokenGrids("quad {} stands in no record", quad - quads_.begin());
        if (const auto t = std::ranges::find(loose_, false); t != loose_.end())
            return brokenGrids("loose triangle {} stands in no record", t - loose_.begin());
        return {};
    }

  private:
    std::span<const VertexGrid> table_;
    std::vector<bool> quads_;
    std::vector<bool> loose_;
};

QuadRange quadsOfPaper(const uint8_t* record) {
    const PaperPlace p = paperPlace(record);
    return {p.grid, p.gridColumn, p.gridRow, p.columns, p.rows, p.gridColumns, p.gridRows};
}

}  // namespace

Status check(const EncodedGrids& grids, const Executor& executor, ProgressSink& progress) {
    if (const Status status = checkLatticeNumbers(grids.lattice); !status) return status;
    const auto base = grids.paper.exponentBase;
    if (base < PaperCode::leastBase || base > PaperCode::mostBase)
        return brokenGrids("exponent base {}, expected {} to {}", base, PaperCode::leastBase,
                           PaperCode::mostBase);
    if (const Status status = checkOffsets(grids); !status) return status;
    if (const Status status = bvh::check(grids.nodes, grids.leafCount()); !status) return status;
    const RecordCheck records(grids);
    std::vector<Box> boxes(grids.leafCount());
    const Stage stage(executor, progress, "check", boxes.size(), "records");
    const Status status = firstFailure(boxes.size(), stage, [&](size_t k) -> Status {
        const Result<Box> box = records.boxOf(k);
        if (!box) return box.error();
        boxes[k] = *box;
        return {};
    });
    if (!status) return status;
    if (const Status whole = stage.status(); !whole) return whole;
    return BoxCheck(grids.nodes, boxes).run();
}

Status checkPlaces(const EncodedGrids& grids, std::span<const VertexGrid> table, uint32_t looseTriangles) {
    const RecordSpans spans(grids);
    // A table that claims more than the records can hold must not cost memory.
    const uint64_t quads = table.empty() ? 0 : table.back().firstQuad + table.back().quadCount();
    if (quads > spans.count() * mostQuads || looseTriangles > spans.count() * maxClusterTriangles)
        return brokenGrids("{} quads and {} loose triangles, too many for {} records", quads, looseTriangles,
                           spans.count());
    Coverage coverage(table, looseTriangles);
    const auto cluster = std::make_unique<ClusterTriangles>();
    for (size_t k = 0; k < spans.count(); ++k) {
        const uint8_t* const record = grids.records.data() + spans.begin(k);
        Status status;
        if (spans.isCluster(k)) {
            decodeClusterPlain(record, *cluster);
            status = coverage.markLoose(cluster->firstTriangle, cluster->triangleCount);
        } else if (grids.codec == Codec::paper) {
            status = coverage.markQuads(quadsOfPaper(record));
        } else {
            const TilePlace p = tilePlace(record);
            if (p.grid >= table.size())
                return brokenGrids("record {}: grid {}, expected below {}", k, p.grid, table.size());
            const VertexGrid& grid = table[p.grid];
            status = coverage.markQuads(
                {p.grid, p.column, p.row, p.columns, p.rows, grid.columns - 1, grid.rows - 1});
        }
        if (!status) return status.error().within(fmt::format("record {}", k));
    }
    return coverage.everything();
}

}  // namespace filigree::grid
