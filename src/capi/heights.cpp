#include "filigree/grid/heightfield.h"

#include "capi/arguments.h"
#include "capi/mesh.h"
#include "capi/sized.h"

#include <cmath>
#include <cstring>

namespace filigree::capi {
namespace {

constexpr filigree_heightfield heightDefaults = FILIGREE_HEIGHTFIELD_INIT;
constexpr uint32_t mostVertices = 65536;  // along a side

float coordinateOf(double value, std::string_view name) {
    const auto coordinate = static_cast<float>(value);
    if (!std::isfinite(coordinate))
        fail(FILIGREE_ERROR_ARGUMENT, "{}: {} is no finite coordinate", name, value);
    return coordinate;
}

template <class T>
grid::GridMesh gridOfType(const filigree_heightfield& from) {
    const size_t stride = from.height_stride != 0 ? from.height_stride : sizeof(T);
    const size_t rowStride = from.row_stride != 0 ? from.row_stride : stride * from.columns;
    const auto* first = static_cast<const unsigned char*>(from.heights);
    return grid::gridOfHeights(from.columns, from.rows, from.cell, [&](uint32_t column, uint32_t row) {
        T value;
        std::memcpy(&value, first + row * rowStride + column * stride, sizeof value);
        return coordinateOf(value * from.height_scale, "heights");
    });
}

}  // namespace

grid::GridMesh gridOf(const filigree_heightfield* given) {
    const filigree_heightfield from = takenOf(given, heightDefaults, "heights");
    required(static_cast<const unsigned char*>(from.heights), "heights.heights");
    within(from.columns, 2U, mostVertices, "heights.columns");
    within(from.rows, 2U, mostVertices, "heights.rows");
    if (!(from.cell > 0))
        fail(FILIGREE_ERROR_ARGUMENT, "heights.cell: is {}, expected more than 0", from.cell);
    coordinateOf(from.cell * mostVertices, "heights.cell");
    if (from.height_scale == 0) fail(FILIGREE_ERROR_ARGUMENT, "heights.height_scale: is 0");
    coordinateOf(from.height_scale, "heights.height_scale");
    switch (enumerator(from.type, FILIGREE_TEXEL_F32, "heights.type")) {
        case FILIGREE_TEXEL_U8:
            return gridOfType<uint8_t>(from);
        case FILIGREE_TEXEL_U16:
            return gridOfType<uint16_t>(from);
        default:
            return gridOfType<float>(from);
    }
}

}  // namespace filigree::capi

filigree_error filigree_heightfield_init(filigree_heightfield* heightfield, size_t struct_size) {
    return filigree::capi::initialise(heightfield, struct_size, filigree::capi::heightDefaults);
}
