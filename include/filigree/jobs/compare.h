// Every encoding on one scene, level by level: what its micromaps take (Waldemarson and Doggett 2024, table 2
// and figure 5).
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"
#include "filigree/report/chart.h"
#include "filigree/report/page.h"
#include "filigree/report/table.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

struct CompareOptions {
    std::filesystem::path input;         // .glb or .gltf; micromaps that it carries are passed over
    std::vector<unsigned> levels;        // 0..12, rising
    std::vector<unsigned> states{2, 4};  // 2, 4 or both
    BakeParameters parameters;           // when a state is known; states and levels are those above
    std::filesystem::path outputFolder;  // for a CSV file and charts; empty: none are written
    std::filesystem::path page;          // .html with charts and tables; empty: none is written
};

// An encoding at one level. All bytes are those of the whole scene, equal maps once.
struct CompareRow {
    std::string method;
    unsigned level = 0;
    unsigned states = 4;
    uint64_t maps = 0;  // distinct
    uint64_t payloadBytes = 0;
    uint64_t descriptorBytes = 0;
    uint64_t indexBytes = 0;   // of all masked triangles, the same rule for all: io::filIndexBits
    double encodeSeconds = 0;  // 0 where the size is known without
    [[nodiscard]] uint64_t totalBytes() const { return payloadBytes + descriptorBytes + indexBytes; }
};

struct CompareSummary {
    std::string scene;                // file name
    uint64_t triangles = 0;           // of the whole scene
    uint64_t maskedTriangles = 0;     // of primitives with micromaps
    std::vector<CompareRow> rows;     // by states, then level, then method
    uint64_t textureBytes = 0;        // one a texel of the distinct alpha images of masked primitives
    uint64_t vertexBytes = 0;         // eight, the texture coordinates, for each vertex of a masked triangle
    uint64_t triangleIndexBytes = 0;  // twelve a masked triangle
    double seconds = 0;
    uint64_t peakBytes = 0;  // of the process, since it began
    std::vector<std::string> notes;
};

// Bakes and encodes at each level. Flat and gruen are counted, not made. Encodings that this version lacks
// are left out with a note.
Result<CompareSummary> compare(const CompareOptions& options, const Executor& executor,
                               ProgressSink& progress);

// One row a level, one column a method: payload and descriptors. The last column is the indices of all.
report::Table comparisonTable(const CompareSummary& summary, unsigned states);

// One row for each of the summary, all figures.
report::Table rowTable(const CompareSummary& summary);

// The totals over the level.
report::LineChart comparisonChart(const CompareSummary& summary, unsigned states);

// Charts and tables of all, for a page.
std::vector<report::Section> comparisonSections(const CompareSummary& summary, const CompareOptions& options);

// The machine-readable result: one JSON object.
std::string toJson(const CompareSummary& summary);

}  // namespace filigree::jobs
