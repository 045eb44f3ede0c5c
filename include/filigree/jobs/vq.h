// Opacity squares of textures and of scenes: what each encoding saves (Fenney and Ozkan 2023, figures 6 to
// 10).
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/report/chart.h"
#include "filigree/report/table.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filigree::jobs {

// What is measured on each map. The first six are no encoders: the squares themselves, and what else the bits
// of VQ2 and VQ4 could hold.
enum class VqMeasure : uint8_t {
    source8,
    source16,
    source32,
    source64,
    masks,  // a 64-sub-triangle mask for each triangle, 256 bits
    raw16,  // source16 at 2 bits a region, 512 bits
    vq2Literal,
    vq2Sensible,
    vq2Best,
    vq4Paper,
    vq4Fast,
    vq4Best,
    vq2Plus,
    vq4Plus,
};
inline constexpr size_t vqMeasureCount = 14;
inline constexpr size_t vqFirstEncoder = 6;

template <class T>
using PerMeasure = std::array<T, vqMeasureCount>;

struct VqOptions {
    // PNGs, whose grey is the alpha where they have none: one square each, over the texels of alpha > 0. And
    // scenes (.glb, .gltf), whose masked triangles give a square for each pair.
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path outputFolder;
    char prefer = 0;               // 'T' or 'O': the state that encoders favour; 0 for neither
    std::optional<double> cutoff;  // [0, 1]; without it 0.5, and each material's own
    double guard = 1.0 / 256;      // texels, >= 0: how far each region is widened before it is decided
    size_t limit = 0;              // textures, the first of the inputs; 0 for all
    size_t mapsPerTexture = 64;    // of a scene's texture: so many distinct pairs, evenly spread; 0 for all
    bool pictures = true;
};

// Sums over maps.
struct VqTotals {
    uint64_t maps = 0;
    PerMeasure<double> savings{};          // divided by `maps` a share of regions
    PerMeasure<uint64_t> substitutions{};  // known regions made mixed; encoders alone
    PerMeasure<double> seconds{};          // of encoders, on one thread
    void add(const VqTotals& other);
    [[nodiscard]] double mean(VqMeasure measure) const;
};

struct VqTexture {
    std::string name;
    VqTotals totals;
    uint64_t pairs = 0;    // of triangles, before those that are alike; a texture on its own has one
    uint64_t singles = 0;  // triangles without a partner
};

// How often combinations of quadrant transforms were chosen.
struct TransformUse {
    uint64_t used = 0;    // different combinations, of 512
    uint64_t unique = 0;  // of these, chosen by one map alone
    uint64_t most = 0;    // maps that share the most frequent one
    uint64_t maps = 0;
    [[nodiscard]] double mostFrequentShare() const;
};

struct VqSummary {
    std::vector<VqTexture> textures;
    VqTotals totals;
    TransformUse vq2;  // of the best encoder
    TransformUse vq4;
    double seconds = 0;
    std::vector<std::string> notes;
};

// Measures, and writes charts, pictures and tables into the folder.
Result<VqSummary> vq(const VqOptions& options, const Executor& executor, ProgressSink& progress);

// One row a measure: its mean savings, what it keeps of its source's, substitutions, maps a second.
report::Table vqTable(const VqSummary& summary);

// One row a texture.
report::Table vqTextureTable(const VqSummary& summary);

// The machine-readable result: one JSON object.
std::string toJson(const VqSummary& summary);

}  // namespace filigree::jobs
