#include "quadmap/vq4_search.h"

#include "quadmap/vq4_book.h"

#include <algorithm>
#include <numeric>

namespace filigree::quadmap {
namespace {

constexpr unsigned allPasses = 100;

// Groups in the order in which they join, the fullest first.
std::vector<unsigned> groupsOf(const Demand4& demand) {
    std::vector<unsigned> groups(groupCount(demand.layout));
    std::iota(groups.begin(), groups.end(), 0U);
    std::ranges::stable_sort(groups, [&](unsigned a, unsigned b) {
        return demand.stored[a][0].size() > demand.stored[b][0].size();
    });
    return groups;
}

// A book for some of the groups.
struct Draft {
    Book4 book;
    unsigned total = 0;
};

// The vectors of some groups as they look when stored.
struct Gathered {
    std::vector<Vector4> vectors;
    VectorLanes lanes;

    Gathered(const Demand4& demand, const std::array<Transform, 8>& transforms,
             std::span<const unsigned> groups) {
        for (const unsigned group : groups) {
            for (const Vector4& vector : demand.stored[group][transforms[group]]) {
                vectors.push_back(vector);
                lanes.add(vector);
            }
        }
    }
};

// Small, fast and the same everywhere (Steele and others 2014, SplitMix).
class Random {
  public:
    unsigned below(unsigned limit) {
        state_ += 0x9e3779b97f4a7c15U;
        uint64_t z = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return static_cast<unsigned>(((z ^ (z >> 31)) >> 32) * limit >> 32);
    }

  private:
    uint64_t state_ = 0;
};

class Search4 {
  public:
    Search4(const Demand4& demand, const Effort4& effort)
        : demand_(demand), effort_(effort), groups_(groupsOf(demand)) {
        for (unsigned group = 0; group < groupCount(demand.layout); ++group) {
            for (Transform t = 0; t < transformCount; ++t) {
                for (const Vector4& vector : demand.stored[group][t]) groupLanes_[group][t].add(vector);
            }
        }
    }

    Book4 run() {
        std::vector<Draft> drafts(1);
        for (size_t count = 1; count <= groups_.size(); ++count) drafts = joined(drafts, count);
        for (Draft& draft : drafts) settle(draft);
        Draft best = *std::ranges::max_element(drafts, {}, &Draft::total);
        for (unsigned k = 0; k < effort_.perturbations && best.total < demand_.total; ++k) perturb(best);
        return best.book;
    }

  private:
    // The drafts with one more group, groups_[count - 1].
    std::vector<Draft> joined(const std::vector<Draft>& drafts, size_t count) {
        const unsigned group = groups_[count - 1];
        std::vector<Draft> longer;
        for (const Draft& draft : drafts) {
            for (const Transform t : promising(draft, group, count == 1)) {
                Draft next = draft;
                next.book.transforms[group] = t;
                rebook(next, std::span(groups_).first(count), effort_.passes);
                longer.push_back(std::move(next));
            }
        }
        std::ranges::stable_sort(longer, std::ranges::greater(), &Draft::total);
        if (longer.size() > effort_.beam) longer.resize(effort_.beam);
        return longer;
    }

    // The transforms of a group for which the book does best as it is. The first group's may be any, since
    // all others and the words can turn along.
    [[nodiscard]] std::vector<Transform> promising(const Draft& draft, unsigned group, bool first) const {
        if (first) return {0};
        std::vector<Transform> transforms(transformCount);
        std::iota(transforms.begin(), transforms.end(), Transform{0});
        std::ranges::stable_sort(transforms, std::ranges::greater(), [&](Transform t) {
            return bookGain(groupLanes_[group][t], draft.book.words, demand_.weights);
        });
        transforms.resize(std::min(effort_.tries, transformCount));
        return transforms;
    }

    // A better book for the groups.
    void rebook(Draft& draft, std::span<const unsigned> groups, unsigned passes) const {
        const Gathered gathered(demand_, draft.book.transforms, groups);
        const Candidates4 candidates(gathered.lanes, gathered.vectors, demand_.weights);
        BookSearch search(gathered.lanes, demand_.layout, demand_.weights, draft.book.words);
        search.improve(candidates, passes);
        while (search.refit(gathered.vectors) && passes == allPasses) search.improve(candidates, passes);
        draft.book.words = search.words();
        draft.total = search.total();
    }

    // The best transforms for the book as it is. True if that gains.
    bool turn(Draft& draft) const {
        unsigned total = 0;
        for (const unsigned group : groups_) {
            unsigned most = 0;
            const auto gain = [&](Transform t) {
                return bookGain(groupLanes_[group][t], draft.book.words, demand_.weights);
            };
            Transform& best = draft.book.transforms[group];
            most = gain(best);
            for (Transform t = 0; t < transformCount; ++t) {
                const unsigned other = gain(t);
                if (other <= most) continue;
                most = other;
                best = t;
            }
            total += most;
        }
        const bool better = total > draft.total;
        draft.total = total;
        return better;
    }

    // Book and transforms in turn, until neither gains.
    void settle(Draft& draft) const {
        do {
            rebook(draft, groups_, allPasses);
        } while (turn(draft));
    }

    // Other transforms for one or two groups, or some words less; kept unless that loses.
    void perturb(Draft& best) {
        Draft other = best;
        const unsigned kind = random_.below(4);
        if (kind < 2 || other.book.words.empty()) {
            for (unsigned k = 0; k <= kind % 2; ++k) {
                const unsigned group = groups_[random_.below(static_cast<unsigned>(groups_.size()))];
                other.book.transforms[group] = static_cast<Transform>(random_.below(transformCount));
            }
        } else {
            for (unsigned k = 1 + random_.below(4); k > 0 && !other.book.words.empty(); --k) {
                const unsigned word = random_.below(static_cast<unsigned>(other.book.words.size()));
                other.book.words.erase(other.book.words.begin() + word);
            }
        }
        settle(other);
        if (other.total >= best.total) best = std::move(other);
    }

    const Demand4& demand_;
    Effort4 effort_;
    std::vector<unsigned> groups_;
    std::array<std::array<VectorLanes, transformCount>, 8> groupLanes_;
    Random random_;
};

}  // namespace

Book4 searchVq4(const Demand4& demand, const Effort4& effort) {
    return Search4(demand, effort).run();
}

}  // namespace filigree::quadmap
