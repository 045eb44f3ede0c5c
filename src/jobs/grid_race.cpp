#include "jobs/grid_race.h"

#include "jobs/median.h"
#include "jobs/stopwatch.h"

#include <algorithm>
#include <cmath>

namespace filigree::jobs {
namespace {

const std::vector<grid::Ray>& raysOfKind(const trace::GridRaySets& sets, GridRayKind kind) {
    switch (kind) {
        case GridRayKind::primary:
            return sets.primary;
        case GridRayKind::bounce:
            return sets.bounce;
        case GridRayKind::ao:
            return sets.ao;
        case GridRayKind::shuffled:
            break;
    }
    return sets.shuffled;
}

// All methods over the rays of one kind.
class KindRace {
  public:
    KindRace(std::span<GridMethod* const> methods, std::span<const grid::Ray> rays, GridRayKind kind)
        : methods_(methods),
          rays_(rays),
          kind_(kind),
          distances_(kind == GridRayKind::ao ? 0 : rays.size()),
          answers_(kind == GridRayKind::ao ? rays.size() : 0),
          hits_(methods.size()),
          seconds_(methods.size()) {}

    // Fills the caches, and counts what is hit.
    void warmUp() {
        for (size_t k = 0; k < methods_.size(); ++k) {
            secondsOf(k, oneByOne);
            hits_[k] = hits();
        }
    }

    // Each round another one begins.
    void run(unsigned round) {
        for (size_t k = 0; k < methods_.size(); ++k) {
            const size_t turn = (k + round) % methods_.size();
            seconds_[turn][oneByOne].push_back(secondsOf(turn, oneByOne));
            if (methods_[turn]->hasBatches()) seconds_[turn][asBatch].push_back(secondsOf(turn, asBatch));
        }
    }

    [[nodiscard]] GridSpeed speedOf(size_t method) const {
        const auto& seconds = seconds_[method];
        GridSpeed speed;
        speed.hits = hits_[method];
        // The stock method's own batches are what `ratioToBatches` compares with.
        speed.batched =
            method > 0 && !seconds[asBatch].empty() && median(seconds[asBatch]) < median(seconds[oneByOne]);
        const auto& taken = seconds[speed.batched ? asBatch : oneByOne];
        speed.mraysPerSecond = static_cast<double>(rays_.size()) / median(taken) / 1e6;
        speed.ratio = medianRatio(seconds_.front()[oneByOne], taken);
        speed.ratioToBatches = medianRatio(seconds_.front()[asBatch], taken);
        return speed;
    }

  private:
    enum Way : size_t { oneByOne, asBatch };

    double secondsOf(size_t method, Way way) {
        const ThreadStopwatch watch;
        if (kind_ == GridRayKind::ao) {
            methods_[method]->any(rays_, way == asBatch, answers_);
        } else {
            methods_[method]->closest(rays_, way == asBatch, distances_);
        }
        return watch.seconds();
    }

    [[nodiscard]] uint64_t hits() const {
        const auto found = kind_ == GridRayKind::ao
                               ? std::ranges::count(answers_, 1)
                               : std::ranges::count_if(distances_, [](float t) { return std::isfinite(t); });
        return static_cast<uint64_t>(found);
    }

    std::span<GridMethod* const> methods_;
    std::span<const grid::Ray> rays_;
    GridRayKind kind_;
    std::vector<float> distances_;
    std::vector<uint8_t> answers_;
    std::vector<uint64_t> hits_;                               // [method]
    std::vector<std::array<std::vector<double>, 2>> seconds_;  // [method][way][round]
};

}  // namespace

Result<std::vector<GridSpeeds>> raceGrids(std::span<GridMethod* const> methods,
                                          const trace::GridRaySets& sets, unsigned rounds,
                                          ProgressSink& progress) {
    std::vector<GridSpeeds> speeds(methods.size());
    for (size_t kind = 0; kind < gridRayKindCount; ++kind) {
        const auto& rays = raysOfKind(sets, static_cast<GridRayKind>(kind));
        if (rays.empty()) continue;
        KindRace race(methods, rays, static_cast<GridRayKind>(kind));
        race.warmUp();
        for (unsigned round = 0; round < rounds; ++round) {
            race.run(round);
            if (progress.cancelled()) return Error{ErrorKind::cancelled, "the bench was cancelled"};
        }
        for (size_t k = 0; k < methods.size(); ++k) speeds[k][kind] = race.speedOf(k);
    }
    return speeds;
}

}  // namespace filigree::jobs
