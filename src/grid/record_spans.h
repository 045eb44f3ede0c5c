// Where records begin and end.
#pragma once

#include "filigree/grid/encoded_grids.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace filigree::grid {

// Records that follow each other without gaps.
class RecordSpans {
  public:
    // `bytes` of records, without slack.
    RecordSpans(std::span<const uint32_t> offsets, size_t bytes) : offsets_(offsets), bytes_(bytes) {}
    explicit RecordSpans(const EncodedGrids& grids)
        : RecordSpans(grids.offsets, grids.records.size() - EncodedGrids::recordSlack) {}

    [[nodiscard]] size_t count() const { return offsets_.empty() ? bytes_ / 128 : offsets_.size(); }
    [[nodiscard]] bool isCluster(size_t k) const {
        return !offsets_.empty() && (offsets_[k] & EncodedGrids::clusterBit) != 0;
    }
    [[nodiscard]] size_t begin(size_t k) const {
        if (offsets_.empty()) return 128 * k;
        return size_t{offsets_[k] & ~EncodedGrids::clusterBit} * EncodedGrids::recordUnit;
    }
    [[nodiscard]] size_t end(size_t k) const { return k + 1 < count() ? begin(k + 1) : bytes_; }
    [[nodiscard]] size_t size(size_t k) const { return end(k) - begin(k); }

  private:
    std::span<const uint32_t> offsets_;
    size_t bytes_;
};

}  // namespace filigree::grid
