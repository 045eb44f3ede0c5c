// How fast rays are with each way to test alpha.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"
#include "filigree/jobs/render.h"
#include "filigree/report/table.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filigree::jobs {

struct BenchTraceOptions {
    std::vector<std::filesystem::path> inputs;  // .glb or .gltf; micromaps that they carry are passed over
    std::vector<unsigned> levels{4, 6, 8};      // 0..12
    std::vector<unsigned> states{2, 4};         // 2, 4 or both
    std::vector<std::string> methods;           // as for render; empty: all
    std::vector<std::string> rays{"primary", "shadow", "ao"};  // or "path"
    unsigned rounds = 5;                                       // at least 1
    uint32_t width = 480;  // pixels of the picture whose rays are cast again
    uint32_t height = 270;
    // Nothing, unlike in render: the file's first camera, or without one a place from which rays meet many
    // alpha tests.
    CameraChoice camera;
    bool overview = false;       // without a camera look as render does
    uint32_t atlas = 0;          // texels a side; 0: textures stay as they are
    BakeParameters parameters;   // when a state is known; states and level are those above
    std::filesystem::path page;  // .html with charts and tables; empty: none
};

// Medians over the rounds, in which all methods and levels take turns on one thread.
struct BenchTraceRow {
    std::string scene;  // file name
    std::string rays;
    std::string method;
    std::optional<unsigned> states;  // none where a method has none
    std::optional<unsigned> level;
    double mraysPerSecond = 0;  // of CPU time, of these rays alone: nothing is shaded
    double ratioToTexture = 0;  // of speeds in one round: above 1 is faster
    double leastRatio = 0;
    double mostRatio = 0;
    double fetchesPerRay = 0;  // alpha tests that read the texture
    double testsPerRay = 0;    // candidate hits
    double bitsPerLookup = 0;
    uint64_t opacityBytes = 0;  // in memory for lookups: payload, descriptors, and indices
};

struct BenchTraceSummary {
    std::vector<BenchTraceRow> rows;
    std::vector<std::string> notes;
};

// ErrorKind::format when a method that must find the same hits as the texture finds others.
Result<BenchTraceSummary> benchTrace(const BenchTraceOptions& options, const Executor& executor,
                                     ProgressSink& progress);

// A row for each of the summary.
report::Table benchTraceTable(const BenchTraceSummary& summary);

// The machine-readable result: one JSON object.
std::string toJson(const BenchTraceSummary& summary);

}  // namespace filigree::jobs
