#include "filigree/encoding/lossy.h"

#include "filigree/micromap/distinct_trees.h"

#include "encoding/lossy_prune.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace filigree::encoding {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr unsigned curveTrials = 8;    // between the lossless set and one that keeps nothing
constexpr unsigned goalTrials = 12;    // at most
constexpr double finestStep = 1.001;   // from price to price
constexpr double closeEnough = 0.995;  // of the goal

std::vector<micromap::QuadtreeView> viewsOf(const micromap::QuadtreeList& maps) {
    std::vector<micromap::QuadtreeView> views;
    for (size_t k = 0; k < maps.size(); ++k) views.push_back(maps[k]);
    return views;
}

// Encodes at one price after another and keeps what meets the goal best.
class Trials {
  public:
    Trials(Encoding encoding, std::span<const WeightedMap> maps, micromap::Format format,
           const EncodeOptions& options, const LossyGoal& goal, const Executor& executor)
        : encoding_(encoding),
          maps_(maps),
          format_(format),
          options_(options),
          goal_(goal),
          executor_(executor) {}

    // The first trial: everything is kept.
    Status runLossless() {
        LossySet trial;
        for (const WeightedMap& map : maps_) {
            trial.indices.push_back(static_cast<int32_t>(trial.maps.size()));
            trial.maps.push(map.tree);
        }
        trial.point.price = infinity;
        if (const Status encoded = encodeTrial(trial); !encoded) return encoded;
        // Masks of what may be opaque lose what is known, as 4-state does.
        const bool conservative = options_.maybeOpaque && format_ == micromap::Format::twoState;
        pruner_ = makePruner(maps_, trial.set, conservative ? micromap::Format::fourState : format_);
        keep(std::move(trial));
        return {};
    }

    // Adds a point to the curve.
    Result<LossyPoint> run(double price) {
        const PrunedMaps pruned = pruner_->prune(price, executor_);
        LossySet trial;
        micromap::DistinctTrees distinct;
        for (const micromap::Quadtree& map : pruned.maps) trial.indices.push_back(distinct.add(map.view()));
        trial.maps = std::move(distinct).take();
        trial.point = {0, pruned.cost, price};
        if (const Status encoded = encodeTrial(trial); !encoded) return encoded.error();
        const LossyPoint point = trial.point;
        keep(std::move(trial));
        return point;
    }

    [[nodiscard]] const std::vector<LossyPoint>& points() const { return points_; }

    // The curve is what was tried so far, and the best.
    void endCurve() { curvePoints_ = points_.size(); }
    [[nodiscard]] std::vector<LossyPoint> curvePoints() const {
        std::vector<LossyPoint> points(points_.begin(),
                                       points_.begin() + static_cast<std::ptrdiff_t>(curvePoints_));
        if (best_) points.push_back(best_->point);
        return points;
    }

    [[nodiscard]] bool keepsGoal(const LossyPoint& point) const {
        return goal_.maxBytes ? point.bytes <= *goal_.maxBytes : point.cost <= *goal_.maxCost;
    }

    // The best trial, if one keeps the goal.
    std::optional<LossySet> take() && { return std::move(best_); }

  private:
    Status encodeTrial(LossySet& trial) {
        auto set = encode(encoding_, viewsOf(trial.maps), format_, options_, executor_);
        if (!set) return set.error();
        trial.set = std::move(*set);
        trial.point.bytes = trial.set.descriptors.size() + trial.set.payload.size();
        return {};
    }

    void keep(LossySet trial) {
        points_.push_back(trial.point);
        if (!keepsGoal(trial.point) || (best_ && !isBetter(trial.point, best_->point))) return;
        best_ = std::move(trial);
    }

    [[nodiscard]] bool isBetter(const LossyPoint& a, const LossyPoint& b) const {
        if (goal_.maxCost) return a.bytes < b.bytes || (a.bytes == b.bytes && a.cost < b.cost);
        return a.cost < b.cost;
    }

    Encoding encoding_;
    std::span<const WeightedMap> maps_;
    micromap::Format format_;
    EncodeOptions options_;
    LossyGoal goal_;
    const Executor& executor_;
    std::unique_ptr<Pruner> pruner_;
    std::vector<LossyPoint> points_;
    size_t curvePoints_ = 0;
    std::optional<LossySet> best_;
};

// The points that no other beats in both, by falling bytes. The first of `points`, which is lossless, stays.
std::vector<LossyPoint> curveOf(std::vector<LossyPoint> points) {
    std::stable_sort(points.begin() + 1, points.end(), [](const LossyPoint& a, const LossyPoint& b) {
        return a.cost != b.cost ? a.cost < b.cost : a.bytes < b.bytes;
    });
    std::vector<LossyPoint> curve;
    for (const LossyPoint& point : points) {
        if (curve.empty() || point.bytes < curve.back().bytes) curve.push_back(point);
    }
    return curve;
}

// A part of the curve between two neighbours: `from` has more bytes, at a higher price.
struct Segment {
    LossyPoint from;
    LossyPoint to;

    // A price between the two. Where one of them is no price to reckon with, the slope of the line through
    // both is one: above it lies `from`, below it `to`.
    [[nodiscard]] double middle() const {
        const bool high = std::isfinite(from.price);
        const bool low = to.price > 0;
        if (high && low) return std::sqrt(from.price * to.price);
        const double slope = 8 * static_cast<double>(from.bytes - to.bytes) / (to.cost - from.cost);
        if (high) return std::min(slope, from.price / stride);
        return low ? std::max(slope, to.price * stride) : slope;
    }
    [[nodiscard]] bool holds(const LossyPoint& p) const { return p.bytes < from.bytes && p.bytes > to.bytes; }
    [[nodiscard]] bool operator==(const Segment& other) const {
        return from.bytes == other.from.bytes && to.bytes == other.to.bytes;
    }

    static constexpr double stride = 8;
};

class Search {
  public:
    Search(Trials& trials, const LossyGoal& goal, ProgressSink& progress)
        : trials_(trials), goal_(goal), progress_(progress) {}

    Status run() {
        progress_.begin("fit", curveTrials + goalTrials + 3, "trials");
        if (const Status first = trials_.runLossless(); !first) return first;
        progress_.advance(1);
        for (const double price : {infinity, 0.0}) {
            if (const Status tried = tryPrice(price); !tried) return tried;
        }
        for (unsigned k = 0; k < curveTrials; ++k) {
            if (const Status split = splitWidest(); !split) return split;
        }
        trials_.endCurve();
        if (const Status closed = closeIn(); !closed) return closed;
        progress_.end();
        return {};
    }

  private:
    Status tryPrice(double price) {
        if (progress_.cancelled()) return Error{ErrorKind::cancelled, "the compression was cancelled"};
        const auto point = trials_.run(price);
        if (!point) return point.error();
        last_ = *point;
        progress_.advance(1);
        return {};
    }

    // Those that may have a point between.
    [[nodiscard]] std::vector<Segment> segments() const {
        const std::vector<LossyPoint> curve = curveOf(trials_.points());
        std::vector<Segment> all;
        for (size_t k = 0; k + 1 < curve.size(); ++k) {
            const Segment segment{curve[k], curve[k + 1]};
            const bool open = segment.to.cost > segment.from.cost;
            if (open && std::ranges::find(closed_, segment) == closed_.end()) all.push_back(segment);
        }
        return all;
    }

    Status splitWidest() {
        const auto all = segments();
        const auto widest = std::ranges::max_element(
            all, {}, [](const Segment& segment) { return segment.from.bytes - segment.to.bytes; });
        if (widest == all.end()) return {};
        if (const Status tried = tryPrice(widest->middle()); !tried) return tried;
        if (!widest->holds(last_)) closed_.push_back(*widest);
        return {};
    }

    // Halves the prices around the goal.
    Status closeIn() {
        const auto all = segments();
        const auto around = std::ranges::find_if(all, [&](const Segment& segment) {
            return trials_.keepsGoal(segment.from) != trials_.keepsGoal(segment.to);
        });
        if (around == all.end()) return {};
        Segment left = *around;
        for (unsigned k = 0; k < goalTrials && !isClose(left); ++k) {
            if (const Status tried = tryPrice(left.middle()); !tried) return tried;
            const bool likeFrom = trials_.keepsGoal(last_) == trials_.keepsGoal(left.from);
            (likeFrom ? left.from : left.to) = last_;
        }
        return {};
    }

    [[nodiscard]] bool isClose(const Segment& around) const {
        if (around.from.price <= around.to.price * finestStep || around.from.cost >= around.to.cost)
            return true;
        if (goal_.maxBytes)
            return static_cast<double>(around.to.bytes) >= closeEnough * static_cast<double>(*goal_.maxBytes);
        return around.from.cost >= closeEnough * *goal_.maxCost;
    }

    Trials& trials_;
    const LossyGoal& goal_;
    ProgressSink& progress_;
    std::vector<Segment> closed_;  // without a point between
    LossyPoint last_;
};

}  // namespace

Result<LossySet> encodeLossy(Encoding encoding, std::span<const WeightedMap> maps, micromap::Format format,
                             const EncodeOptions& options, const LossyGoal& goal, const Executor& executor,
                             ProgressSink& progress) {
    assert(goal.maxBytes.has_value() != goal.maxCost.has_value());
    Trials trials(encoding, maps, format, options, goal, executor);
    if (const Status searched = Search(trials, goal, progress).run(); !searched) return searched.error();
    std::vector<LossyPoint> curve = curveOf(trials.curvePoints());
    std::optional<LossySet> best = std::move(trials).take();
    if (!best) {
        return Error{ErrorKind::limit, fmt::format("cannot take {} bytes or fewer: the least is {}",
                                                   *goal.maxBytes, curve.back().bytes)};
    }
    best->curve = std::move(curve);
    return std::move(*best);
}

}  // namespace filigree::encoding
