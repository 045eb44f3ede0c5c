#include "filigree/io/heightfield.h"

#include "filigree/core/file.h"
#include "filigree/grid/heightfield.h"

#include "io/png.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace filigree::io {
namespace {

Status checkHeightfieldOptions(const HeightfieldOptions& options) {
    if (!(options.cell > 0) || !std::isfinite(options.cell)) {
        return Error{ErrorKind::usage, fmt::format("cell {}: expected a positive length", options.cell)};
    }
    if (options.heightScale == 0 || !std::isfinite(options.heightScale)) {
        return Error{ErrorKind::usage,
                     fmt::format("height scale {}: expected a finite number but 0", options.heightScale)};
    }
    return {};
}

// The farthest coordinates, which are the only ones that could leave the range of float.
Status checkExtent(const ImageSize& size, const HeightfieldOptions& options) {
    const double across = options.cell * std::max(size.width, size.height);
    const double high = std::abs(options.heightScale) * 65535;
    if (!std::isfinite(static_cast<float>(across)) || !std::isfinite(static_cast<float>(high))) {
        return Error{ErrorKind::usage,
                     fmt::format("cell {} and height scale {} leave the range of coordinates", options.cell,
                                 options.heightScale)};
    }
    return {};
}

}  // namespace

Result<grid::GridMesh> parseHeightfield(std::span<const uint8_t> png, const HeightfieldOptions& options) {
    if (const Status usable = checkHeightfieldOptions(options); !usable) return usable.error();
    const Result<GreyImage> grey = decodePngGrey(png);
    if (!grey) return grey.error();
    const auto [columns, rows] = grey->size;
    if (columns < 2 || rows < 2) {
        return Error{ErrorKind::format,
                     fmt::format("heightfield of {} x {} texels, expected at least 2 x 2", columns, rows)};
    }
    if (const Status extent = checkExtent(grey->size, options); !extent) return extent.error();
    return grid::gridOfHeights(columns, rows, options.cell, [&](uint32_t column, uint32_t row) {
        return static_cast<float>(grey->values[size_t{row} * grey->size.width + column] *
                                  options.heightScale);
    });
}

Result<grid::GridMesh> readHeightfield(const std::filesystem::path& path, const HeightfieldOptions& options) {
    const Result<std::vector<uint8_t>> bytes = readFile(path, UINT32_MAX);
    if (!bytes) return bytes.error();
    Result<grid::GridMesh> mesh = parseHeightfield(*bytes, options);
    if (!mesh) return mesh.error().within(path.string());
    return mesh;
}

}  // namespace filigree::io
