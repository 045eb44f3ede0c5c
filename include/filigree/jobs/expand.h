// A .fil file back to micromaps that APIs and glTF take.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/encoded_size.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace filigree::jobs {

struct ExpandOptions {
    std::filesystem::path input;      // .fil
    std::filesystem::path asset;      // the .glb or .gltf that it was made from, unchanged
    std::filesystem::path output;     // .glb or .gltf; empty: none is written
    std::filesystem::path rawFolder;  // for API-ready blobs; empty: none are written
};

struct ExpandSummary {
    EncodedSize size;
    uint64_t dataBytes = 0;  // flat
    double totalSeconds = 0;
    uint64_t peakBytes = 0;  // of the process, since it began
    std::vector<std::string> notes;
};

// Checks that the asset is the one that the file names, decodes, and writes what jobs::bake would write. On
// an error no output is left.
Result<ExpandSummary> expand(const ExpandOptions& options, const Executor& executor, ProgressSink& progress);

// The machine-readable result: one JSON object.
std::string toJson(const ExpandSummary& summary);

}  // namespace filigree::jobs
