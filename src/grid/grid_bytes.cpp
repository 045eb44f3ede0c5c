#include "filigree/grid/encode_grids.h"

#include "grid/record_spans.h"

namespace filigree::grid {

GridBytes bytesOf(const EncodedGrids& grids) {
    GridBytes bytes;
    bytes.bvh = grids.nodes.size() * sizeof(bvh::Node) + grids.offsets.size() * sizeof(uint32_t);
    const RecordSpans spans(grids);
    for (size_t k = 0; k < spans.count(); ++k)
        (spans.isCluster(k) ? bytes.clusters : bytes.geometry) += spans.size(k);
    bytes.geometry += EncodedGrids::recordSlack;
    return bytes;
}

uint64_t clusterCount(const EncodedGrids& grids) {
    const RecordSpans spans(grids);
    uint64_t count = 0;
    for (size_t k = 0; k < spans.count(); ++k) count += spans.isCluster(k) ? 1 : 0;
    return count;
}

}  // namespace filigree::grid
