#include "filigree/io/fil.h"
#include "filigree/io/fil_grids.h"
#include "filigree/io/fil_squares.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/context.h"
#include "capi/grids.h"
#include "capi/primitives.h"
#include "capi/set.h"
#include "capi/squares.h"

namespace filigree::capi {
namespace {

constexpr const char* containerName = "container";

std::span<const uint8_t> bytesOf(const void* bytes, size_t size) {
    return listOf(static_cast<const uint8_t*>(bytes), size, "bytes");
}

// What the meta section says of levels has to hold.
void checkLevel(const filigree_set& set, std::optional<unsigned> level) {
    for (uint32_t map = 0; level && map < set.levels.size(); ++map) {
        if (set.levels[map] != *level)
            fail(FILIGREE_ERROR_FORMAT, "container: map {} has level {}, the meta section says {}", map,
                 set.levels[map], *level);
    }
}

Owned<filigree_set> parseSet(const filigree_context* context, std::span<const uint8_t> bytes) {
    const auto file = orFail(io::FilFile::view(bytes, containerName));
    if (!file.pairs().empty())
        fail(FILIGREE_ERROR_UNSUPPORTED, "container: its maps are one bit and a pair of states");
    const Memory memory = memoryOf(context);
    auto set = ownedSet(memory, file.set());
    checkLevel(*set, file.meta().level);
    set->primitives = primitivesOf(memory, file.meta().primitives);
    if (!set->maps) return set;
    set->indices = Array<int32_t>(memory, file.meta().triangleCount());
    file.readIndices(0, set->indices.values());
    return set;
}

Owned<filigree_squares> parseSquares(const filigree_context* context, std::span<const uint8_t> bytes) {
    const auto file = orFail(io::FilSquareFile::view(bytes, containerName));
    const Memory memory = memoryOf(context);
    const uint64_t triangles = file.meta().triangleCount();
    Array<int32_t> indices(memory, triangles);
    Array<quadmap::SquarePlace> places(memory, triangles);
    file.readIndices(0, indices.values());
    for (size_t t = 0; t < triangles; ++t) places[t] = file.place(t);
    auto squares =
        squaresOf(memory, file.maps().format(), file.maps().bytes(), std::move(indices), std::move(places));
    squares->primitives = primitivesOf(memory, file.meta().primitives);
    return squares;
}

Owned<filigree_grids> parseGrids(const filigree_context* context, std::span<const uint8_t> bytes) {
    auto grids = makeHandle<filigree_grids>(memoryOf(context));
    grids->file = orFail(io::parseFilGrids(bytes, containerName, executorOf(context)));
    return grids;
}

filigree_container kindOf(std::span<const uint8_t> bytes) {
    if (io::gridsIn(bytes)) return FILIGREE_CONTAINER_GRIDS;
    return io::squaresIn(bytes) ? FILIGREE_CONTAINER_SQUARES : FILIGREE_CONTAINER_SET;
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_set_parse(const filigree_context* context, const void* bytes, size_t size,
                                  filigree_set** out, filigree_error_info* error) {
    return make(out, error, [&] { return parseSet(context, bytesOf(bytes, size)).release(); });
}

filigree_error filigree_squares_parse(const filigree_context* context, const void* bytes, size_t size,
                                      filigree_squares** out, filigree_error_info* error) {
    return make(out, error, [&] { return parseSquares(context, bytesOf(bytes, size)).release(); });
}

filigree_error filigree_grids_parse(const filigree_context* context, const void* bytes, size_t size,
                                    filigree_grids** out, filigree_error_info* error) {
    return make(out, error, [&] { return parseGrids(context, bytesOf(bytes, size)).release(); });
}

filigree_error filigree_validate(const filigree_context* context, const void* bytes, size_t size,
                                 filigree_container* kind, filigree_error_info* error) {
    return call(error, [&] {
        const auto list = bytesOf(bytes, size);
        const filigree_container found = kindOf(list);
        if (kind != nullptr) *kind = found;
        switch (found) {
            case FILIGREE_CONTAINER_GRIDS:
                parseGrids(context, list);
                break;
            case FILIGREE_CONTAINER_SQUARES:
                parseSquares(context, list);
                break;
            default:
                parseSet(context, list);
        }
    });
}
