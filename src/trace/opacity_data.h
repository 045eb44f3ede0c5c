// What an Opacity holds.
#pragma once

#include "filigree/trace/opacity.h"

#include "trace/filter.h"

#include <cstdint>

namespace filigree::trace {

struct Opacity::Data {
    virtual ~Data() = default;

    Method method = Method::none;
    unsigned states = 4;
    AcceptFunction accepts = nullptr;
    uint64_t setBytes = 0;

    // Of what tells the map of each triangle.
    [[nodiscard]] virtual uint64_t indexBytes() const { return 0; }
};

}  // namespace filigree::trace
