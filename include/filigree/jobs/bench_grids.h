// Compressed grids against Embree: bytes, build times and speed.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/report/table.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

struct BenchGridsOptions {
    // Files as for the verb grids, or the names of shapes made in code: terrain, torus.
    std::vector<std::string> scenes{"terrain", "torus"};
    std::vector<uint32_t> sizes{1025, 2049};  // of shapes, vertices a side, 65 to 8193
    // triangles, triangles-compact, triangles-qbvh8, grids, grids-compact, paper, lattice; empty: all these.
    // triangles-robust is there, too.
    std::vector<std::string> methods;
    bool lossless = false;  // `lattice` keeps heightfields exactly; otherwise it errs as `paper` does
    unsigned rounds = 5;    // at least 1
    uint32_t width = 800;   // pixels of the picture whose rays are cast
    uint32_t height = 800;
    uint64_t leakRays = 10'000'000;    // aimed at a closed torus and a box, in all; 0: none
    uint32_t leakSize = 513;           // vertices a side of the torus, and quads a side of the box
    uint64_t memory = 12'000'000'000;  // bytes that methods may take at once; those beyond race one by one
    std::filesystem::path page;        // .html with charts and tables; empty: none
};

// Speeds are medians over rounds in which all methods take turns on one thread, in CPU time. Embree is asked
// ray by ray (rtcIntersect1, rtcOccluded1), the codecs by whichever of their calls is quicker.
struct BenchGridsSpeed {
    double mraysPerSecond = 0;
    double ratio = 0;           // to `triangles`: above 1 is faster
    double ratioToStreams = 0;  // to `triangles` by Embree's stream calls (rtcIntersect1M, rtcOccluded1M)
    uint64_t hits = 0;
    bool batched = false;  // by the call for many rays
};

struct BenchGridsRow {
    std::string scene;
    uint64_t triangles = 0;
    std::string method;
    double bytesPerTriangle = 0;  // all that is resident
    double buildSeconds = 0;      // of the hierarchy, with encoding where there is a codec; on all threads
    uint64_t cacheBytes = 0;      // working memory of a thread, not counted above
    BenchGridsSpeed primary;
    BenchGridsSpeed bounce;
    BenchGridsSpeed ao;
    BenchGridsSpeed shuffled;  // the bounce rays in random order
};

// Rays from inside closed surfaces at their vertices and edges, and how many went through.
struct BenchGridsLeaks {
    std::string scene;
    std::string method;
    uint64_t rays = 0;
    uint64_t misses = 0;
};

struct BenchGridsSummary {
    std::vector<BenchGridsRow> rows;
    std::vector<BenchGridsLeaks> leaks;
    std::vector<std::string> notes;
};

Result<BenchGridsSummary> benchGrids(const BenchGridsOptions& options, const Executor& executor,
                                     ProgressSink& progress);

// A row a scene and method; a row a closed shape and method.
report::Table benchGridsTable(const BenchGridsSummary& summary);
report::Table benchLeaksTable(const BenchGridsSummary& summary);

// The machine-readable result: one JSON object.
std::string toJson(const BenchGridsSummary& summary);

}  // namespace filigree::jobs
