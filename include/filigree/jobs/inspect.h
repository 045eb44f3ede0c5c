// A page to explore a scene's micromaps: states over each masked texture, histograms, what costs most.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace filigree::jobs {

struct InspectOptions {
    std::filesystem::path input;         // .glb or .gltf, with or without micromaps
    std::filesystem::path outputFolder;  // made when missing; existing files of the same names are replaced
    BakeParameters parameters;           // how to bake in memory when the file has no micromaps
    bool full = false;                   // the page holds everything, however large; else less than 10 MB
};

// One masked texture and the micromaps over it.
struct InspectedTexture {
    std::string name;
    std::filesystem::path picture;  // PNG, relative to the output folder
    uint32_t width = 0;             // texels
    uint32_t height = 0;
    uint64_t triangles = 0;
    uint64_t drawnTriangles = 0;  // distinct ones in the picture; a huge scene's picture shows only the first
    uint64_t distinctTriangles = 0;       // by texture coordinates and micromap
    uint64_t micromaps = 0;               // that its triangles use
    uint64_t bytes = 0;                   // of their data and records
    std::array<uint64_t, 4> special{};    // triangles with a special index, by micromap::State
    std::array<uint64_t, 4> states{};     // micro-triangles by micromap::State; a special index counts as one
    std::array<double, 4> area{};         // texels covered by each state, summed over the triangles
    std::map<unsigned, uint64_t> levels;  // micromaps by level
    std::map<uint64_t, uint64_t> sharing;  // micromaps by the number of triangles that share each
    std::map<uint32_t, double> overlaps;   // texels, as a share of all, by the distinct triangles over them

    // The shares of `area`, of one; all 0 without area.
    [[nodiscard]] std::array<double, 4> areaShares() const;
};

struct InspectSummary {
    std::filesystem::path page;                   // index.html
    std::vector<std::filesystem::path> pictures;  // every PNG, relative to the output folder
    bool bakedInMemory = false;
    std::vector<InspectedTexture> textures;
    std::vector<std::string> notes;
};

// Reads, bakes in memory where the file has no micromaps, draws, and writes the page and its pictures.
Result<InspectSummary> inspect(const InspectOptions& options, const Executor& executor,
                               ProgressSink& progress);

// The machine-readable result: one JSON object.
std::string toJson(const InspectSummary& summary);

}  // namespace filigree::jobs
