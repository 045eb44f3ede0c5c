// The methods that a trace bench lets race, each with what it reads.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bench_trace.h"
#include "filigree/scene/scene.h"
#include "filigree/trace/opacity.h"
#include "filigree/trace/world.h"

#include "jobs/opacity_input.h"

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace filigree::jobs {

// A method at one level, ready to be asked.
struct Contestant {
    trace::Method method = trace::Method::texture;
    unsigned states = 4;
    unsigned level = 0;
    std::unique_ptr<OpacityInput> input;  // the opacity looks into it
};

// All methods at the levels and states of the options that they have. Micromaps that the scene came with are
// dropped from it; it and `world` must outlive the result. `input` names the scene in errors.
Result<std::vector<Contestant>> makeContestants(const BenchTraceOptions& options,
                                                std::span<const trace::Method> methods, scene::Scene& scene,
                                                const trace::World& world, const std::filesystem::path& input,
                                                const Executor& executor, ProgressSink& progress);

}  // namespace filigree::jobs
