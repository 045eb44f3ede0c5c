// The primitives that a list of triangles belongs to.
#pragma once

#include "filigree/io/fil.h"

#include "capi/memory.h"
#include "filigree.h"

#include <span>

namespace filigree::capi {

Array<filigree_primitive> primitivesOf(const Memory& memory, std::span<const io::FilPrimitive> primitives);

// One for all triangles; none for none. Throws a Failure where they are too many for a container.
Array<filigree_primitive> onePrimitive(const Memory& memory, size_t triangles);

}  // namespace filigree::capi
