#include "filigree/verify/verify.h"

#include "verify/judge.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>
#include <tuple>

namespace filigree::verify {
namespace {

constexpr size_t mostFindings = 16;
constexpr uint64_t blockSize = 1024;  // micro-triangles of one triangle that are one unit of work
constexpr size_t blocksAtOnce = 16;

bool inOrder(const Finding& a, const Finding& b) {
    return std::tie(a.triangle, a.microTriangle) < std::tie(b.triangle, b.microTriangle);
}

// Adds `from` to `to`; the findings that stay are the same whatever the order of calls.
void add(DeepCounts& to, const DeepCounts& from) {
    to.microTriangles += from.microTriangles;
    to.wrong += from.wrong;
    to.overCautious += from.overCautious;
    to.uncertain += from.uncertain;
    to.first.insert(to.first.end(), from.first.begin(), from.first.end());
    std::ranges::sort(to.first, inOrder);
    if (to.first.size() > mostFindings) to.first.resize(mostFindings);
}

// What a state gets from a verdict.
enum class Grade { right, wrong, overCautious, uncertain };

Grade gradeKnown(bool surelyNot, bool maybeNot) {
    if (surelyNot) return Grade::wrong;
    return maybeNot ? Grade::uncertain : Grade::right;
}

Grade gradeFourState(micromap::State state, const Verdict& verdict) {
    switch (state) {
        case micromap::State::opaque:
            return gradeKnown(verdict.notOpaque, verdict.maybeNotOpaque);
        case micromap::State::transparent:
            return gradeKnown(verdict.notTransparent, verdict.maybeNotTransparent);
        default:
            if (!verdict.maybeNotOpaque || !verdict.maybeNotTransparent) return Grade::overCautious;
            return verdict.decided() ? Grade::right : Grade::uncertain;
    }
}

// Wrong only where all of it is the other side.
Grade gradeTwoState(micromap::State state, const Verdict& verdict) {
    const bool opaque = micromap::isOpaqueSide(state);
    if (!(opaque ? verdict.maybeNotTransparent : verdict.maybeNotOpaque)) return Grade::wrong;
    return (opaque ? verdict.notTransparent : verdict.notOpaque) ? Grade::right : Grade::uncertain;
}

Grade grade(micromap::Format format, micromap::State state, const Verdict& verdict) {
    return format == micromap::Format::fourState ? gradeFourState(state, verdict)
                                                 : gradeTwoState(state, verdict);
}

uint64_t mixed(uint64_t value) {  // the finaliser of SplitMix64 (Steele, Lea and Flood 2014)
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9U;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebU;
    return value ^ (value >> 31);
}

// A number in [0, 1) from the three.
double draw(uint64_t seed, uint64_t triangle, uint64_t microTriangle) {
    constexpr uint64_t golden = 0x9e3779b97f4a7c15U;
    const uint64_t bits = mixed(mixed(mixed(seed + golden) + triangle + golden) + microTriangle + golden);
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

// One triangle's micromap: a record, or a special index as a level-0 one.
struct Micromap {
    const micromap::Record* record = nullptr;
    micromap::State special = micromap::State::unknownOpaque;
    unsigned level = 0;
    micromap::Format format = micromap::Format::fourState;
};

class Check {
  public:
    Check(std::span<const mesh::UvTriangle> triangles, const micromap::FlatSet& set,
          const TextureJudge& judge, const DeepSettings& settings)
        : triangles_(triangles),
          set_(set),
          judge_(judge),
          settings_(settings),
          firstBlock_(triangles.size() + 1) {
        for (size_t t = 0; t < triangles.size(); ++t) {
            firstBlock_[t + 1] = firstBlock_[t] + (size(t) + blockSize - 1) / blockSize;
            total_ += size(t);
        }
    }

    [[nodiscard]] uint64_t total() const { return total_; }

    Result<DeepCounts> run(const Executor& executor, ProgressSink& progress) {
        executor.parallelFor(firstBlock_.back(), blocksAtOnce,
                             [&](size_t begin, size_t end) { checkBlocks(begin, end, progress); });
        if (progress.cancelled()) return Error{ErrorKind::cancelled, "the check was cancelled"};
        return counts_;
    }

  private:
    [[nodiscard]] Micromap micromapOf(size_t triangle) const {
        const int32_t index = set_.indices[triangle];
        if (index < 0) return {nullptr, micromap::stateOfSpecialIndex(index), 0, settings_.specialFormat};
        const micromap::Record& record = set_.records[static_cast<size_t>(index)];
        return {&record, {}, record.level, record.format};
    }
    [[nodiscard]] uint64_t size(size_t triangle) const {
        return micromap::microTriangleCount(micromapOf(triangle).level);
    }

    // Blocks begin..end, which may be of many triangles.
    void checkBlocks(size_t begin, size_t end, ProgressSink& progress) {
        const auto after = std::ranges::upper_bound(firstBlock_, begin);
        auto triangle = static_cast<size_t>(after - firstBlock_.begin()) - 1;
        DeepCounts counts;
        for (size_t block = begin; block < end && !progress.cancelled(); ++triangle) {
            const size_t last = std::min<size_t>(end, firstBlock_[triangle + 1]);
            checkTriangle(triangle, block - firstBlock_[triangle], last - firstBlock_[triangle], counts,
                          progress);
            block = last;
        }
        const std::scoped_lock lock(mutex_);
        add(counts_, counts);
    }

    void checkTriangle(size_t triangle, uint64_t fromBlock, uint64_t toBlock, DeepCounts& counts,
                       ProgressSink& progress) const {
        const TriangleJudge judge(judge_, triangles_[triangle]);
        const Micromap map = micromapOf(triangle);
        const uint64_t all = micromap::microTriangleCount(map.level);
        for (uint64_t block = fromBlock; block < toBlock && !progress.cancelled(); ++block) {
            const uint64_t first = block * blockSize;
            const uint64_t end = std::min(first + blockSize, all);
            for (uint64_t m = first; m < end; ++m) {
                if (settings_.sample < 1 && draw(settings_.seed, triangle, m) >= settings_.sample) continue;
                checkOne(triangle, m, map, judge.verdict(map.level, m), counts);
            }
            progress.advance(end - first);
        }
    }

    void checkOne(size_t triangle, uint64_t m, const Micromap& map, const Verdict& verdict,
                  DeepCounts& counts) const {
        const micromap::State state = map.record ? micromap::flatState(set_, *map.record, m) : map.special;
        ++counts.microTriangles;
        switch (grade(map.format, state, verdict)) {
            case Grade::wrong:
                ++counts.wrong;
                // Triangles come in rising order here, so the first findings are the least.
                if (counts.first.size() < mostFindings) {
                    counts.first.push_back({triangle, m, map.level, state, truthOf(verdict)});
                }
                break;
            case Grade::overCautious:
                ++counts.overCautious;
                break;
            case Grade::uncertain:
                ++counts.uncertain;
                break;
            case Grade::right:
                break;
        }
    }

    std::span<const mesh::UvTriangle> triangles_;
    const micromap::FlatSet& set_;
    const TextureJudge& judge_;
    const DeepSettings& settings_;
    std::vector<uint64_t> firstBlock_;  // [triangle_count + 1]
    uint64_t total_ = 0;
    std::mutex mutex_;
    DeepCounts counts_;
};

bool isAmount(double value) {
    return std::isfinite(value) && value >= 0;
}

Status checkSettings(const image::AlphaTexture& texture, const image::AlphaTest& test,
                     const DeepSettings& settings) {
    const auto usage = [](const std::string& message) { return Error{ErrorKind::usage, message}; };
    if (!isAmount(test.cutoff) || !isAmount(test.factor) || !isAmount(test.guard)) {
        return usage("cutoff, factor and guard must be finite and not negative");
    }
    if (!(settings.sample >= 0 && settings.sample <= 1)) return usage("the share to sample must be 0 to 1");
    return image::check(texture.image);
}

Status checkRecord(const micromap::FlatSet& set, size_t index) {
    const micromap::Record& record = set.records[index];
    const auto broken = [&](const std::string& message) {
        return Error{ErrorKind::format, "micromap record " + std::to_string(index) + ": " + message};
    };
    if (record.format != micromap::Format::twoState && record.format != micromap::Format::fourState) {
        return broken("format " + std::to_string(static_cast<unsigned>(record.format)) + ", expected 1 or 2");
    }
    if (record.level > micromap::maxLevel) {
        return broken("level " + std::to_string(record.level) + ", expected at most " +
                      std::to_string(micromap::maxLevel));
    }
    const uint64_t end = record.byteOffset + micromap::flatBytes(record.level, record.format);
    if (end > set.data.size()) {
        return broken("ends at byte " + std::to_string(end) + " of " + std::to_string(set.data.size()));
    }
    return {};
}

Status checkSet(size_t triangles, const micromap::FlatSet& set) {
    if (set.indices.size() != triangles) {
        return Error{ErrorKind::format, std::to_string(set.indices.size()) + " micromap indices for " +
                                            std::to_string(triangles) + " triangles"};
    }
    for (size_t r = 0; r < set.records.size(); ++r) {
        if (Status status = checkRecord(set, r); !status) return status;
    }
    for (size_t t = 0; t < triangles; ++t) {
        const int64_t index = set.indices[t];
        if (index < -4 || index >= static_cast<int64_t>(set.records.size())) {
            return Error{ErrorKind::format, "triangle " + std::to_string(t) + ": micromap index " +
                                                std::to_string(index) + ", expected -4 to " +
                                                std::to_string(static_cast<int64_t>(set.records.size()) - 1)};
        }
    }
    return {};
}

}  // namespace

Result<DeepCounts> deepCheck(std::span<const mesh::UvTriangle> triangles, const micromap::FlatSet& set,
                             const image::AlphaTexture& texture, const image::AlphaTest& test,
                             const DeepSettings& settings, const Executor& executor, ProgressSink& progress) {
    if (Status status = checkSettings(texture, test, settings); !status) return status.error();
    if (Status status = checkSet(triangles.size(), set); !status) return status.error();
    const TextureJudge judge(texture, test);
    Check check(triangles, set, judge, settings);
    progress.begin("verify", check.total(), "micro-triangles");
    Result<DeepCounts> counts = check.run(executor, progress);
    progress.end();
    return counts;
}

}  // namespace filigree::verify
