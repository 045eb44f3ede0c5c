// How fast micromaps are encoded, and how much a second thread helps.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

struct BenchEncodeOptions {
    std::vector<std::filesystem::path> inputs;  // .glb or .gltf; micromaps that they carry are passed over
    std::vector<unsigned> levels{6, 8, 10};     // 0..12
    std::vector<unsigned> states{2, 4};         // 2, 4 or both
    // Encodings of micromaps. Flat and gruen take a time that depends on micro-triangles, not on nodes.
    std::vector<std::string> methods{"tree", "indexed-tree", "dag", "sdag"};
    unsigned rounds = 5;        // of which the median counts, at least 1
    BakeParameters parameters;  // when a state is known; states and levels are those above
};

struct BenchEncodeRow {
    std::string scene;  // file name
    std::string method;
    unsigned level = 0;
    unsigned states = 4;
    uint64_t nodes = 0;     // of the distinct quadtrees, leaves included
    double secondsOne = 0;  // one thread
    double secondsAll = 0;  // `threads` threads
    unsigned threads = 1;
    double nodesPerSecond = 0;  // one thread
    double speedup = 0;         // median of the ratios within one round
};

struct BenchEncodeSummary {
    std::vector<BenchEncodeRow> rows;
    std::vector<std::string> notes;
};

// Encodes quadtrees in memory on one thread and on those of the executor in turn, and compares the bytes:
// ErrorKind::format when they differ.
Result<BenchEncodeSummary> benchEncode(const BenchEncodeOptions& options, const Executor& executor,
                                       ProgressSink& progress);

// The machine-readable result: one JSON object.
std::string toJson(const BenchEncodeSummary& summary);

}  // namespace filigree::jobs
