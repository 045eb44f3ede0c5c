#include "filigree/grid/record_boxes.h"

#include "filigree/grid/cluster.h"
#include "filigree/grid/tile.h"

#include "grid/cluster_box.h"
#include "grid/record_box.h"
#include "grid/sub_grids.h"

#include <memory>

namespace filigree::grid {

Box boxOfRecord(const EncodedGrids& grids, const RecordSpans& spans, size_t k) {
    const uint8_t* record = grids.records.data() + spans.begin(k);
    if (spans.isCluster(k)) {
        const auto cluster = std::make_unique<ClusterTriangles>();
        decodeClusterPlain(record, *cluster);
        return clusterBox(*cluster, grids.codec, grids.lattice);
    }
    if (grids.codec == Codec::paper) return boxOf(decodePaper(record, grids.paper), paperPlace(record));
    return decodeTile(record).box();
}

std::vector<Box> recordBoxes(const EncodedGrids& grids, const Executor& executor) {
    const RecordSpans spans(grids);
    std::vector<Box> boxes(spans.count());
    executor.parallelFor(boxes.size(), 256, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) boxes[k] = boxOfRecord(grids, spans, k);
    });
    return boxes;
}

}  // namespace filigree::grid
