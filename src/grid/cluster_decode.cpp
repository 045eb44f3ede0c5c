// The plain decoder of clusters, and their check.
#include "grid/cluster_layout.h"

#include <fmt/format.h>

namespace filigree::grid {
namespace {

template <class... Args>
Error brokenCluster(fmt::format_string<Args...> format, Args&&... args) {
    return {ErrorKind::format, "cluster: " + fmt::format(format, std::forward<Args>(args)...)};
}

Status checkClusterHeader(const uint8_t* record, const ClusterHeader& head, uint32_t looseCount) {
    const uint32_t unused = loadLe<uint32_t>(record + 4) >> 31 | loadLe<uint32_t>(record + 8) >> 29 |
                            loadLe<uint32_t>(record + 12) >> 29;
    if (unused != 0) return brokenCluster("unused bits of the header are not zero");
    for (const unsigned width : head.width) {
        if (width > widestOffset) return brokenCluster("width {}, expected at most {}", width, widestOffset);
    }
    if (head.tilted > 2) return brokenCluster("tilted axis {}, expected at most 2", head.tilted);
    if (head.vertices > 3 * head.triangles || head.roots > head.triangles) {
        return brokenCluster("{} vertices and {} roots for {} triangles", head.vertices, head.roots,
                             head.triangles);
    }
    if (uint64_t{head.firstTriangle} + head.triangles > looseCount) {
        return brokenCluster("triangles {} to {}, expected below {}", head.firstTriangle,
                             uint64_t{head.firstTriangle} + head.triangles - 1, looseCount);
    }
    return {};
}

// Whether right and left make as many roots as the header says, and no edge is left over.
Status checkRoots(const uint8_t* record, const ClusterHeader& head, const ClusterParts& parts) {
    uint32_t roots = 0;
    uint64_t stacked = 0;
    for (uint32_t t = 0; t < head.triangles; ++t) {
        if (stacked == 0) {
            ++roots;
        } else {
            --stacked;
        }
        stacked += clusterBits(record, parts.right + t, 1) + clusterBits(record, parts.left + t, 1);
    }
    if (roots == head.roots && stacked == 0) return {};
    return brokenCluster("{} roots and {} edges left over, expected {} and 0", roots, stacked, head.roots);
}

// How many indices are not fresh; `record` holds all flags.
Result<uint32_t> countKnown(const uint8_t* record, const ClusterHeader& head, const ClusterParts& parts) {
    uint32_t fresh = 0;
    for (uint32_t i = 0; i < head.indices(); ++i)
        fresh += static_cast<uint32_t>(clusterBits(record, parts.fresh + i, 1));
    if (fresh == head.vertices) return head.indices() - fresh;
    return brokenCluster("{} of {} vertices come up", fresh, head.vertices);
}

// Known indices name vertices that have come up.
Status checkKnown(const uint8_t* record, const ClusterHeader& head, const ClusterParts& parts) {
    const unsigned width = head.indexWidth();
    uint32_t fresh = 0;
    uint32_t at = parts.known;
    for (uint32_t i = 0; i < head.indices(); ++i) {
        if (clusterBits(record, parts.fresh + i, 1) != 0) {
            ++fresh;
            continue;
        }
        const uint64_t index = clusterBits(record, at, width);
        if (index >= fresh) return brokenCluster("index {} of {} vertices so far", index, fresh);
        at += width;
    }
    return {};
}

Status checkTail(std::span<const uint8_t> record, uint32_t bits) {
    for (size_t at = bits; at < 8 * record.size(); ++at) {
        if ((record[at / 8] >> at % 8 & 1) != 0) return brokenCluster("bits behind the last are not zero");
    }
    return {};
}

// Gives the indices one after another.
class IndexReader {
  public:
    IndexReader(const uint8_t* record, const ClusterHeader& head, const ClusterParts& parts)
        : record_(record), width_(head.indexWidth()), flag_(parts.fresh), known_(parts.known) {}

    uint8_t next() {
        if (clusterBits(record_, flag_++, 1) != 0) return fresh_++;
        const uint64_t index = clusterBits(record_, known_, width_);
        known_ += width_;
        return static_cast<uint8_t>(index);
    }

  private:
    const uint8_t* record_;
    unsigned width_;
    uint32_t flag_;
    uint32_t known_;
    uint8_t fresh_ = 0;
};

void decodeVertices(const uint8_t* record, const ClusterHeader& head, const ClusterParts& parts,
                    ClusterTriangles& out) {
    const auto [a, b] = levelAxes(head.tilted);
    for (uint32_t v = 0; v < head.vertices; ++v) {
        std::array<int32_t, 3> offset{};
        for (size_t axis = 0; axis < 3; ++axis) {
            const uint32_t at = parts.offsets[axis] + v * head.width[axis];
            offset[axis] = static_cast<int32_t>(clusterBits(record, at, head.width[axis]));
        }
        offset[head.tilted] += tiltOf(head.slope, offset[a], offset[b]);
        for (size_t axis = 0; axis < 3; ++axis) {
            const uint32_t sum = head.origin[axis] + static_cast<uint32_t>(offset[axis]);
            out.vertices[axis][v] = static_cast<int32_t>(sum % latticeLimit);
        }
    }
}

void decodeCorners(const uint8_t* record, const ClusterHeader& head, const ClusterParts& parts,
                   ClusterTriangles& out) {
    IndexReader indices(record, head, parts);
    std::array<std::array<uint8_t, 2>, maxClusterTriangles + 1> stack;
    size_t stacked = 0;
    for (uint32_t t = 0; t < head.triangles; ++t) {
        std::array<uint8_t, 2> edge{};
        if (stacked == 0) {
            edge[0] = indices.next();
            edge[1] = indices.next();
        } else {
            edge = stack[--stacked];
        }
        const uint8_t apex = indices.next();
        out.corners[0][t] = edge[0];
        out.corners[1][t] = edge[1];
        out.corners[2][t] = apex;
        if (clusterBits(record, parts.left + t, 1) != 0) stack[stacked++] = {edge[0], apex};
        if (clusterBits(record, parts.right + t, 1) != 0) stack[stacked++] = {apex, edge[1]};
    }
}

}  // namespace

Result<size_t> checkCluster(std::span<const uint8_t> bytes, uint32_t looseCount) {
    if (bytes.size() < clusterHeaderBytes)
        return brokenCluster("{} bytes, expected at least {}", bytes.size(), clusterHeaderBytes);
    const ClusterHeader head = loadClusterHeader(bytes.data());
    if (const Status status = checkClusterHeader(bytes.data(), head, looseCount); !status)
        return status.error();
    const ClusterParts parts = clusterParts(head);
    const size_t least = clusterBytes(head, 0);
    if (bytes.size() < least) return brokenCluster("{} bytes, expected at least {}", bytes.size(), least);
    // What is read below lies in a copy with slack.
    std::vector<uint8_t> record(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(least));
    record.resize(least + EncodedGrids::recordSlack);
    if (const Status status = checkRoots(record.data(), head, parts); !status) return status.error();
    const Result<uint32_t> known = countKnown(record.data(), head, parts);
    if (!known) return known.error();
    const size_t size = clusterBytes(head, *known);
    if (bytes.size() < size) return brokenCluster("{} bytes, expected {}", bytes.size(), size);
    record.assign(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(size));
    const Status tail = checkTail(record, parts.known + *known * head.indexWidth());
    if (!tail) return tail.error();
    record.resize(size + EncodedGrids::recordSlack);
    if (const Status status = checkKnown(record.data(), head, parts); !status) return status.error();
    return size;
}

void decodeClusterPlain(const uint8_t* record, ClusterTriangles& out) {
    const ClusterHeader head = loadClusterHeader(record);
    const ClusterParts parts = clusterParts(head);
    out.firstTriangle = head.firstTriangle;
    out.triangleCount = head.triangles;
    out.vertexCount = head.vertices;
    decodeVertices(record, head, parts, out);
    decodeCorners(record, head, parts, out);
}

}  // namespace filigree::grid
