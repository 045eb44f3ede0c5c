// A scene to a scene with opacity micromaps.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/scene/scene.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filigree::jobs {

// How to bake, whatever the scene comes from.
struct BakeParameters {
    unsigned states = 4;  // 2 or 4
    // The level of every micromap, 0..12. Without it each triangle gets its highest useful level, at most
    // maxLevel.
    std::optional<unsigned> level;
    unsigned maxLevel = 8;  // 0..12
    // Bytes that data and records may take together (indices depend on the triangles alone); levels, up to
    // those that would be used without, are then chosen for fewest any-hit calls.
    std::optional<uint64_t> budget;
    // A known state also holds at this many coarser mip levels; above what an image has, at all of them.
    unsigned mips = 0;
    double guard = 1.0 / 256;  // texels, >= 0: how far each micro-triangle is widened before it is decided
    std::optional<double> cutoff;  // [0, 1]; without it each material's own
    bool includeBlend = false;     // BLEND materials too
    bool rotate = false;  // a triangle's indices may rotate (winding kept) where it then shares a micromap
};

// As BakeParameters::mips: every mip level that there is.
inline constexpr unsigned allMips = ~0U;

// ErrorKind::usage, naming the option of the command line, when a parameter is out of range.
Status check(const BakeParameters& parameters);

// What a bake made. Triangles and micro-triangles count once for each primitive, however often it is placed.
struct BakeSummary {
    uint64_t triangles = 0;             // of the whole scene
    uint64_t maskedTriangles = 0;       // of primitives that got micromaps
    uint64_t micromaps = 0;             // records
    std::array<uint64_t, 4> special{};  // triangles with a special index, by micromap::State
    std::array<uint64_t, micromap::maxLevel + 1> levels{};  // records by level
    uint64_t dataBytes = 0;
    uint64_t recordBytes = 0;
    uint64_t indexBytes = 0;
    uint64_t microTriangles = 0;  // of all masked triangles, shared or special or not
    uint64_t knownMicroTriangles = 0;
    // With a budget: expected any-hit cost of the choice, and the least that the relaxed problem allows.
    std::optional<double> budgetCost;
    std::optional<double> budgetBound;
    double readSeconds = 0;
    double bakeSeconds = 0;
    double writeSeconds = 0;
    double totalSeconds = 0;
    std::vector<std::string> notes;  // what was passed over and what to beware of, one line each

    [[nodiscard]] double knownShare() const {
        return microTriangles > 0
                   ? static_cast<double>(knownMicroTriangles) / static_cast<double>(microTriangles)
                   : 0;
    }
};

// Bakes every material that asks for it, onto the scene itself: replaces Scene::micromaps and, of each
// primitive, `micromaps` and `micromapIndices` (and `indices` where parameters.rotate turned a triangle). One
// entry of Scene::micromaps for each distinct alpha source (image, sampler, factor, cutoff, mode), shared by
// all primitives that use it. The times of the summary stay 0 except bakeSeconds. ErrorKind::usage for
// parameters out of range.
Result<BakeSummary> bakeScene(scene::Scene& scene, const BakeParameters& parameters, const Executor& executor,
                              ProgressSink& progress);

struct BakeOptions {
    std::filesystem::path input;      // .glb or .gltf
    std::filesystem::path output;     // .glb or .gltf; empty: none is written
    std::filesystem::path rawFolder;  // for API-ready blobs; empty: none are written
    BakeParameters parameters;
};

// Reads, bakes and writes. On an error no output is left.
Result<BakeSummary> bake(const BakeOptions& options, const Executor& executor, ProgressSink& progress);

// The machine-readable result: one JSON object.
std::string toJson(const BakeSummary& summary);

}  // namespace filigree::jobs
