// Does a file keep the rules, and do its micromaps tell the truth?
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/io/breach.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filigree::jobs {

struct ValidateOptions {
    std::filesystem::path input;  // .glb, .gltf, .fil, or a folder that bake --raw wrote
    bool deep = false;            // also examine every micro-triangle against its texture
    // With deep: the share of micro-triangles examined, (0, 1].
    double sample = 1.0;
};

struct DeepSummary {
    uint64_t microTriangles = 0;  // examined; triangles that are alike count once
    uint64_t wrong = 0;           // known, but not true throughout
    uint64_t overCautious = 0;    // unknown, though one side throughout
    uint64_t uncertain = 0;       // closer to the cutoff than the arithmetic can tell; in neither count
};

struct ValidateSummary {
    std::vector<io::Breach> breaches;
    std::optional<DeepSummary>
        deep;  // with ValidateOptions::deep, when the rules hold well enough to read the file
    std::vector<std::string> notes;

    // No rule is broken and no state is wrong.
    [[nodiscard]] bool valid() const { return breaches.empty() && (!deep || deep->wrong == 0); }
};

// An error means that the file could not be examined at all; breaches are part of the result.
Result<ValidateSummary> validate(const ValidateOptions& options, const Executor& executor,
                                 ProgressSink& progress);

// The machine-readable result: one JSON object.
std::string toJson(const ValidateSummary& summary);

}  // namespace filigree::jobs
