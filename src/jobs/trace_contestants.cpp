#include "jobs/trace_contestants.h"

#include "jobs/level_sweep.h"

#include <algorithm>
#include <map>
#include <utility>

namespace filigree::jobs {
namespace {

using trace::Method;

class ContestantMaker {
  public:
    ContestantMaker(const BenchTraceOptions& options, std::span<const Method> methods, scene::Scene& scene,
                    const trace::World& world, const std::filesystem::path& input, const Executor& executor,
                    ProgressSink& progress)
        : options_(options),
          methods_(methods),
          scene_(scene),
          world_(world),
          input_(input),
          executor_(executor),
          progress_(progress) {}

    Result<std::vector<Contestant>> run() {
        for (const Method method : methods_) {
            const Status made = hasLevels(method) ? Status() : addWithoutLevel(method);
            if (!made) return made.error();
        }
        for (const unsigned level : options_.levels) {
            for (const unsigned states : options_.states) {
                if (const Status made = addAt(level, states); !made) return made.error();
            }
        }
        return std::move(contestants_);
    }

  private:
    Status addWithoutLevel(Method method) {
        SceneMaps maps;
        if (readsMaps(method)) {
            // The groups of textures are the same at every level, and cheapest at the lowest.
            auto baked = bake(0, 4);
            if (!baked) return baked.error();
            maps = std::move(*baked);
        }
        for (const unsigned states : hasStates(method) ? options_.states : std::vector<unsigned>{4}) {
            const Status added =
                readsSquares(method) ? addSquares(method, states) : add(method, states, 0, maps);
            if (!added) return added;
        }
        return {};
    }

    Status addAt(unsigned level, unsigned states) {
        std::map<unsigned, SceneMaps> baked;  // by states
        for (const Method method : methods_) {
            if (!hasLevels(method)) continue;
            const unsigned wanted = method == Method::gruen ? 4 : states;
            if (!baked.contains(wanted)) {
                auto maps = bake(level, wanted);
                if (!maps) return maps.error();
                baked.emplace(wanted, std::move(*maps));
            }
            if (const Status added = add(method, states, level, baked.at(wanted)); !added) return added;
        }
        return {};
    }

    Result<SceneMaps> bake(unsigned level, unsigned states) {
        return bakeAt(scene_, input_, options_.parameters, level, states, executor_, progress_);
    }

    Status add(Method method, unsigned states, unsigned level, const SceneMaps& maps) {
        return keep(method, states, level, makeOpacity(method, states, scene_, maps, world_, executor_));
    }

    Status addSquares(Method method, unsigned states) {
        return keep(
            method, states, 0,
            makeSquareOpacity(method, states, scene_, options_.parameters, world_, executor_, progress_));
    }

    Status keep(Method method, unsigned states, unsigned level, Result<OpacityInput> input) {
        if (!input) return input.error();
        contestants_.push_back({method, states, level, std::make_unique<OpacityInput>(std::move(*input))});
        return {};
    }

    const BenchTraceOptions& options_;
    std::span<const Method> methods_;
    scene::Scene& scene_;
    const trace::World& world_;
    const std::filesystem::path& input_;
    const Executor& executor_;
    ProgressSink& progress_;
    std::vector<Contestant> contestants_;
};

}  // namespace

Result<std::vector<Contestant>> makeContestants(const BenchTraceOptions& options,
                                                std::span<const trace::Method> methods, scene::Scene& scene,
                                                const trace::World& world, const std::filesystem::path& input,
                                                const Executor& executor, ProgressSink& progress) {
    return ContestantMaker(options, methods, scene, world, input, executor, progress).run();
}

}  // namespace filigree::jobs
