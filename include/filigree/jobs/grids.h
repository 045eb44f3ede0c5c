// A mesh or heightfield as compressed vertex grids with a hierarchy, in a .fil (docs/spec/fil.md).
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/grid/encode_grids.h"
#include "filigree/grid/error.h"
#include "filigree/grid/statistics.h"
#include "filigree/report/table.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filigree::jobs {

// How far decoded vertices may lie from their sources. At most one of the three is given; none is
// `matchPaper`.
struct GridPrecision {
    std::optional<double> maxError;  // world units, or a share of the diagonal of the mesh's box
    bool isShare = false;            // of `maxError`
    // The root mean square error of the paper's codec over all vertices: its sub-grids on the same grids, and
    // no error at those of loose triangles. Where it has none, or there are no grids, 1e-5 of the diagonal.
    bool matchPaper = false;
    bool lossless = false;
};

struct GridsOptions {
    std::filesystem::path input;  // .glb, .gltf, .ply, or .png: a grey heightfield
    std::filesystem::path output;
    std::string codec = "lattice";  // or "paper"
    GridPrecision precision;        // Codec::lattice alone
    // "unit-vector" or "shared-exponent": the displacements of Codec::paper, or of the paper's codec that is
    // matched. Empty: unit-vector.
    std::string displacement;
    bool snap = false;  // Codec::paper: cut sub-grids where the surface would crack
    std::optional<double> cell;
    std::optional<double> heightScale;  // heightfields; io::HeightfieldOptions
    bool attributes = true;             // keep normals, texture coordinates and sources
    bool zstd = false;                  // compress each section of the file that becomes smaller
    std::filesystem::path errorMap;     // PNG of the error of each sub-grid; empty: none
    std::filesystem::path page;         // .html with pictures, charts and tables; empty: none
    uint32_t width = 960;               // pixels of its pictures
    uint32_t height = 540;
};

struct GridsSummary {
    grid::GridStatistics statistics;
    grid::Codec codec = grid::Codec::lattice;
    grid::Lattice lattice;           // of Codec::lattice
    std::optional<double> paperRms;  // that was matched, world units
    uint64_t grids = 0;
    uint64_t clusters = 0;
    grid::GridBytes bytes;
    uint64_t attributeBytes = 0;  // not in `bytes`
    uint64_t fileBytes = 0;
    double diagonal = 0;  // of the box around all vertices, world units
    grid::GridErrors errors;
    std::optional<grid::Cracks> cracks;  // of Codec::paper
    double readSeconds = 0;
    double convertSeconds = 0;  // with the choice of the lattice
    double encodeSeconds = 0;
    double buildSeconds = 0;
    double totalSeconds = 0;
    std::vector<std::string> notes;

    [[nodiscard]] double bytesPerTriangle() const {
        return static_cast<double>(bytes.total()) / static_cast<double>(statistics.triangles);
    }
};

// Reads, converts, encodes, measures and writes. On an error no output is left.
Result<GridsSummary> grids(const GridsOptions& options, const Executor& executor, ProgressSink& progress);

// Tables 1 and 3 of the paper, and how large the grids are.
report::Table gridMemoryTable(const GridsSummary& summary);
report::Table gridErrorTable(const GridsSummary& summary);
report::Table gridSizeTable(const GridsSummary& summary);

// The machine-readable result: one JSON object.
std::string toJson(const GridsSummary& summary);

}  // namespace filigree::jobs
