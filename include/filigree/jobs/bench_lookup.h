// How long one lookup takes in each encoding.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filigree::jobs {

struct BenchLookupOptions {
    std::vector<std::filesystem::path> inputs;  // .glb or .gltf; micromaps that they carry are passed over
    std::vector<unsigned> levels{4, 6, 8, 10};  // 0..12
    std::vector<unsigned> states{2, 4};         // 2, 4 or both
    std::vector<std::string> methods;           // names of encodings; empty: all
    std::vector<std::string> patterns{"random", "hits"};  // of points, see BenchLookupRow
    uint64_t lookups = 1 << 20;  // of a run, 2..2^26; a 64th of them with the tree, whose scans are long
    unsigned rounds = 5;         // of which the median counts, at least 1
    BakeParameters parameters;   // when a state is known; states and levels are those above
};

// The median of CPU time over the rounds, in which methods take turns.
struct BenchLookupRow {
    std::string scene;  // file name
    std::string method;
    unsigned level = 0;
    unsigned states = 4;
    // "random": random points of random triangles. "hits": where rays of ambient occlusion meet them, ray by
    // ray.
    std::string pattern;
    // "dependent": which point is next depends on the state found; "independent"; "batch": blocks of 1024
    // points by the reader's SIMD lookup.
    std::string mode;
    double nsPerLookup = 0;
    // Medians of the ratios within one round; none where that method was not asked for.
    std::optional<double> ratioToFlat;
    std::optional<double> ratioToDag;
};

struct BenchLookupSummary {
    std::vector<BenchLookupRow> rows;
    std::vector<std::string> notes;
};

// Looks up by barycentrics (bitmasks: by texture coordinates) on this thread, and compares what the methods
// find: ErrorKind::format when one of them disagrees. The executor bakes and encodes. Triangles with special
// indices need no lookup and are left out.
Result<BenchLookupSummary> benchLookup(const BenchLookupOptions& options, const Executor& executor,
                                       ProgressSink& progress);

// The machine-readable result: one JSON object.
std::string toJson(const BenchLookupSummary& summary);

}  // namespace filigree::jobs
