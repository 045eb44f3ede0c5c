// A scene's micromaps in one of the encodings, as a .fil file (docs/spec/fil.md).
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"
#include "filigree/jobs/encoded_size.h"
#include "filigree/jobs/loss.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filigree::jobs {

struct CompressOptions {
    std::filesystem::path input;   // .glb or .gltf
    std::filesystem::path output;  // .fil
    std::string encoding = "sdag";
    // How to bake; without budget and rotation. A scene that carries micromaps is not baked unless
    // `bakeAnew`.
    BakeParameters parameters;
    bool bakeAnew = false;
    bool zstd = false;        // compress each section of the file that becomes smaller
    bool aggregates = false;  // encoding::EncodeOptions::aggregates; sdag alone
    LossOptions loss;
};

struct CompressSummary {
    EncodedSize size;
    bool baked = false;            // here, and not read with the scene
    uint64_t triangles = 0;        // of the whole scene
    uint64_t maskedTriangles = 0;  // of primitives with micromaps
    uint64_t indexBytes = 0;
    uint64_t fileBytes = 0;
    double readSeconds = 0;
    double bakeSeconds = 0;
    double encodeSeconds = 0;
    double writeSeconds = 0;
    double totalSeconds = 0;
    uint64_t peakBytes = 0;  // of the process, since it began
    std::optional<LossySummary> lossy;
    std::optional<OneBitSummary> oneBit;
    std::vector<std::string> notes;
};

// Reads, bakes, encodes and writes, never making the maps flat (but Encoding::flat and gruen). On an error no
// output is left.
Result<CompressSummary> compress(const CompressOptions& options, const Executor& executor,
                                 ProgressSink& progress);

// The machine-readable result: one JSON object.
std::string toJson(const CompressSummary& summary);

}  // namespace filigree::jobs
