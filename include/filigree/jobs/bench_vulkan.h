// How fast a Vulkan device renders with each way to test alpha: table 3 of Waldemarson and Doggett 2024 for
// the device at hand.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/jobs/bake.h"
#include "filigree/jobs/render.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filigree::jobs {

struct BenchVulkanOptions {
    std::vector<std::filesystem::path> inputs;  // .glb or .gltf; micromaps that they carry are passed over
    std::vector<unsigned> levels{2, 4, 6};      // 0..12
    std::vector<unsigned> states{2, 4};         // 2, 4 or both
    // As for render, and "hardware"; empty: all that the device can.
    std::vector<std::string> methods;
    std::vector<std::string> builds{"fast-trace", "fast-build"};  // of hardware micromaps
    std::string path;                                             // query or pipeline; empty: all that it has
    std::string device;                                           // name or number; empty: the best
    std::string integrator = "ao";
    unsigned rounds = 5;   // at least 1
    unsigned samples = 1;  // of each pixel
    uint32_t width = 480;  // pixels
    uint32_t height = 270;
    // Nothing: the file's first camera, or without one a place from which rays meet many alpha tests.
    CameraChoice camera;
    BakeParameters parameters;  // when a state is known; states and level are those above
};

// Medians over the rounds, in which all rows of a scene take turns.
struct BenchVulkanRow {
    std::string scene;  // file name
    std::string path;   // query or pipeline
    std::string method;
    std::optional<std::string> build;  // of hardware micromaps
    std::optional<unsigned> states;    // none where a method has none
    std::optional<unsigned> level;
    double frameMs = 0;         // milliseconds of the device's clock for one picture
    double ratioToTexture = 0;  // of speeds in one round on the same path: above 1 is faster
    uint64_t opacityBytes = 0;  // on the device for what the method looks into
};

struct BenchVulkanSummary {
    std::string device;
    std::string driver;
    std::vector<BenchVulkanRow> rows;
    std::vector<std::string> notes;
};

// ErrorKind::unsupported without a device that traces rays, or where it lacks what is asked for.
// ErrorKind::format when a method that must draw what the texture draws does not.
Result<BenchVulkanSummary> benchVulkan(const BenchVulkanOptions& options, const Executor& executor,
                                       ProgressSink& progress);

// The machine-readable result: one JSON object.
std::string toJson(const BenchVulkanSummary& summary);

}  // namespace filigree::jobs
