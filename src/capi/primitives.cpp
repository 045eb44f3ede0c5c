#include "capi/primitives.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/fill.h"
#include "capi/set.h"
#include "capi/squares.h"

namespace filigree::capi {

Array<filigree_primitive> primitivesOf(const Memory& memory, std::span<const io::FilPrimitive> primitives) {
    Array<filigree_primitive> list(memory, primitives.size());
    for (size_t k = 0; k < list.size(); ++k)
        list[k] = {primitives[k].mesh, primitives[k].primitive, primitives[k].triangles};
    return list;
}

Array<filigree_primitive> onePrimitive(const Memory& memory, size_t triangles) {
    if (triangles > UINT32_MAX)
        fail(FILIGREE_ERROR_LIMIT, "{} triangles, expected less than 2^32", triangles);
    Array<filigree_primitive> list(memory, triangles > 0 ? 1 : 0);
    if (triangles > 0) list[0] = {0, 0, static_cast<uint32_t>(triangles)};
    return list;
}

}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_set_get_primitives(const filigree_set* set, filigree_primitive* to, size_t capacity,
                                           size_t* count, filigree_error_info* error) {
    return call(error, [&] { fillFrom(required(set, "set").primitives.values(), to, capacity, count); });
}

filigree_error filigree_squares_get_primitives(const filigree_squares* squares, filigree_primitive* to,
                                               size_t capacity, size_t* count, filigree_error_info* error) {
    return call(error,
                [&] { fillFrom(required(squares, "squares").primitives.values(), to, capacity, count); });
}
