// A scene to a picture, with any way to test its alpha, and where the tests went.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/report/table.h"
#include "filigree/trace/counters.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace filigree::jobs {

// A camera of one's own: world units, and the vertical angle of view in degrees.
struct OwnCamera {
    std::array<float, 3> eye{};
    std::array<float, 3> target{};
    std::array<float, 3> up{0, 1, 0};
    float fov = 45;
};

// Nothing: the file's first camera, or without one a view that trace::overview chooses. A number: that one of
// the file's cameras, from 0.
using CameraChoice = std::variant<std::monostate, unsigned, OwnCamera>;

enum class HeatmapOf : uint8_t { tests, bits };

struct RenderOptions {
    std::filesystem::path input;   // .glb or .gltf, or the grids of a .fil
    std::filesystem::path output;  // .png
    // .glb or .gltf whose masked and blended triangles stand among the grids; empty: none.
    std::filesystem::path scene;
    std::string method = "micromap";
    unsigned states = 4;            // 4: unknown states fetch the texture; 2: their side decides
    std::optional<unsigned> level;  // of a bake; none: the highest useful one per triangle, at most 8
    // `states` and `level` were asked for. Without a level a file's own micromaps are taken where it has any,
    // and otherwise the highest useful level is at most 6.
    bool statesGiven = false;
    bool levelGiven = false;
    std::string integrator = "ao";
    uint32_t width = 960;  // pixels
    uint32_t height = 540;
    unsigned spp = 16;  // samples a pixel, at least 1
    uint32_t seed = 1;
    CameraChoice camera;
    unsigned bounces = 3;
    bool defer = false;
    bool twoStateShadows = false;
    std::filesystem::path heatmap;  // .png; empty: none
    HeatmapOf heatmapOf = HeatmapOf::tests;
    std::filesystem::path triptych;   // .png; empty: none
    std::filesystem::path page;       // .html with picture, heat maps and tables; empty: none
    std::vector<std::string> beside;  // other methods that the page sets beside `method`
    double previewSeconds = 0;        // 0: none
    // "cpu", or "vulkan": a device, which `device` names by number or part of its name; empty: the best.
    std::string backend = "cpu";
    std::string device;
    std::string path;  // how a device traces: "query" or "pipeline"; empty: queries where it has them
    // The method "hardware" alone: what the device's own micromaps are built for, "fast-trace" or
    // "fast-build"; empty: fast-trace.
    std::string build;
};

// What a picture cost where the texture is asked every time, and how far it differs.
struct TriptychSummary {
    uint64_t textureFetches = 0;
    bool identical = false;
    double psnr = 0;  // dB over the channels of the 8-bit sRGB pictures; infinite where identical
};

// Of a picture with compressed grids.
struct RenderedGrids {
    std::string codec;
    uint64_t triangles = 0;
    uint64_t bytes = 0;  // all that is resident: records, hierarchy, clusters
};

struct RenderSummary {
    std::string method;
    std::optional<unsigned> states;  // none where the method has none
    bool hasLevels = false;          // of the method
    std::optional<unsigned> level;   // of all maps; none where they differ
    std::string integrator;
    uint32_t width = 0;
    uint32_t height = 0;
    unsigned spp = 0;
    trace::Counters counters;
    uint64_t opacityBytes = 0;
    uint64_t textureBytes = 0;
    uint64_t geometryBytes = 0;
    uint64_t bvhBytes = 0;
    uint64_t peakBytes = 0;         // of the process, since it began
    std::string imageSha256;        // of the picture's RGBA, row by row
    double firstSampleSeconds = 0;  // from the start to the first ray
    double seconds = 0;             // of tracing alone; counting bits takes up to a tenth of it
    double totalSeconds = 0;
    std::optional<TriptychSummary> triptych;
    std::string backend;
    std::string device;  // its name and driver; empty: the CPU
    std::string driver;
    std::string path;
    std::string build;         // of hardware micromaps; empty: the method is another
    double deviceSeconds = 0;  // that the shaders took, by the device's clock
    std::optional<RenderedGrids> grids;
    std::vector<std::string> notes;

    [[nodiscard]] double mraysPerSecond() const;
};

// Reads, prepares, renders and writes. Pictures are written when all are done; previews remain on an error.
// ErrorKind::usage for options out of range and methods that are not there.
Result<RenderSummary> render(const RenderOptions& options, const Executor& executor, ProgressSink& progress);

// What the rays of each kind cost.
report::Table rayTable(const RenderSummary& summary);

// The machine-readable result: one JSON object.
std::string toJson(const RenderSummary& summary);

}  // namespace filigree::jobs
