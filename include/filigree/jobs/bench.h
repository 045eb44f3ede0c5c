// Timings of the baker on fixed inputs: the tables of docs/results.md.
#pragma once

#include "filigree/core/progress.h"
#include "filigree/core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

struct BenchBakeOptions {
    // A folder with leaf_1024x1024.u8, quad.* and rand20k.* (docs/results.md); empty: a leaf and triangles
    // made in code.
    std::filesystem::path inputFolder;
    unsigned threads = 1;  // 0: one for each processor
    unsigned repeats = 3;  // the best of so many runs counts, at least 1
    // Micro-triangles examined by the independent check in each row; all where a row has fewer.
    uint64_t checked = 1'000'000;
    bool quick = false;  // only the rows that take under a second
};

struct BenchBakeRow {
    std::string input;  // "quad" or "rand20k"
    unsigned level = 0;
    unsigned states = 4;
    unsigned threads = 1;
    double cpuSeconds = 0;  // of all threads
    double wallSeconds = 0;
    double microTrianglesPerSecond = 0;  // by wall time
    uint64_t bytes = 0;                  // data and records
    double knownShare = 0;
    uint64_t wrong = 0;
    uint64_t overCautious = 0;
    uint64_t checked = 0;  // micro-triangles that the two counts above come from
};

struct BenchBakeSummary {
    std::vector<BenchBakeRow> rows;
};

Result<BenchBakeSummary> benchBake(const BenchBakeOptions& options, ProgressSink& progress);

// The machine-readable result: one JSON object.
std::string toJson(const BenchBakeSummary& summary);

}  // namespace filigree::jobs
