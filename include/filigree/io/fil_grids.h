// Compressed grids in a .fil (docs/spec/fil.md).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/grid/attributes.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/io/fil.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace filigree::io {

// All that a file holds.
struct FilGrids {
    FilAsset asset;  // what the grids were made from
    grid::EncodedGrids grids;
    std::vector<grid::VertexGrid> table;  // without gaps
    uint32_t looseTriangles = 0;
    grid::GridAttributes attributes;

    [[nodiscard]] uint64_t quadCount() const {
        return table.empty() ? 0 : table.back().firstQuad + table.back().quadCount();
    }
    [[nodiscard]] uint64_t triangleCount() const { return 2 * quadCount() + looseTriangles; }
};

// As writeFil. `grids` must pass grid::check and grid::checkPlaces.
FILIGREE_API Result<uint64_t> writeFilGrids(const std::filesystem::path& path, const FilGrids& grids,
                                            bool zstd);

// The same file in memory.
FILIGREE_API std::vector<uint8_t> encodeFilGrids(const FilGrids& grids, bool zstd);

// Reads a file and checks it in full, grid::check and grid::checkPlaces included: it may be traced.
FILIGREE_API Result<FilGrids> readFilGrids(const std::filesystem::path& path,
                                           const Executor& executor = serialExecutor(),
                                           const FilReadOptions& options = {});

// The same from memory. `name` stands for the file in errors.
FILIGREE_API Result<FilGrids> parseFilGrids(std::span<const uint8_t> bytes, const std::string& name,
                                            const Executor& executor = serialExecutor(),
                                            const FilReadOptions& options = {});

// The codec of the grids that a .fil holds; none where it holds something else or cannot be read.
FILIGREE_API std::optional<grid::Codec> gridsIn(const std::filesystem::path& path);
FILIGREE_API std::optional<grid::Codec> gridsIn(std::span<const uint8_t> bytes);

}  // namespace filigree::io
