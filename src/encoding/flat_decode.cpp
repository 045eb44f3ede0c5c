#include "filigree/encoding/flat.h"

#include "encoding/checks.h"
#include "encoding/records.h"

namespace filigree::encoding {

Result<FlatReader> FlatReader::open(const EncodedView& set) {
    if (const auto size = checkDescriptorBytes(set, micromap::recordBytes); !size) return size.error();
    if (const auto records = checkRecords(set, "format", static_cast<unsigned>(set.format)); !records)
        return records.error();
    return FlatReader(set, openedAs<filigree_flat>(filigree_flat_open, set));
}

micromap::Quadtree FlatReader::decode(uint32_t map) const {
    const uint64_t bytes = micromap::flatBytes(level(map), set_.format);
    return micromap::quadtreeFromFlat(set_.payload.subspan(recordOf(set_, map).offset, bytes), level(map),
                                      set_.format);
}

std::vector<Part> FlatReader::parts() const {
    return partsOfRecords(set_);
}

}  // namespace filigree::encoding
