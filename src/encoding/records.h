// Sets whose maps are arrays of states, one after another, with a record for each: offset, level, and what
// the states mean (docs/spec/flat.md, gruen.md).
#pragma once

#include "filigree/core/bytes.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/set.h"
#include "filigree/micromap/state.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace filigree::encoding {

struct MapRecord {
    uint32_t offset = 0;  // bytes into the payload
    uint16_t level = 0;
    uint16_t form = 0;
};

inline MapRecord recordOf(const EncodedView& set, uint32_t map) {
    const uint8_t* from = set.descriptors.data() + micromap::recordBytes * map;
    return {loadLe<uint32_t>(from), loadLe<uint16_t>(from + 4), loadLe<uint16_t>(from + 6)};
}

// The maps fill the payload without gaps, each record has `form`, which `name` calls so in errors, and bits
// behind a map's last state are zero.
Status checkRecords(const EncodedView& set, std::string_view name, unsigned form);

// Of a set that has been checked.
std::vector<Part> partsOfRecords(const EncodedView& set);

}  // namespace filigree::encoding
