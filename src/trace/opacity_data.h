// What an Opacity holds.
#pragma once

#include "filigree/trace/opacity.h"

#include "trace/filter.h"

#include <vector>

namespace filigree::trace {

struct Opacity::Data {
    virtual ~Data() = default;

    Method method = Method::none;
    unsigned states = 4;
    AcceptFunction accepts = nullptr;
    std::vector<SurfaceMaps> surfaces;
};

}  // namespace filigree::trace
