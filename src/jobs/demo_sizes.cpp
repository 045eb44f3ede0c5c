#include "jobs/demo_sizes.h"

#include "filigree/jobs/compare.h"
#include "filigree/jobs/vq.h"

namespace filigree::jobs {
namespace {

constexpr const char* comparePage = "compare.html";
constexpr const char* vqFolder = "vq";

Result<report::Section> compareDemo(const std::filesystem::path& scene, const std::filesystem::path& folder,
                                    const Executor& executor, ProgressSink& progress) {
    CompareOptions options;
    options.input = scene;
    options.levels = {1, 2, 3, 4, 5, 6, 7, 8};
    options.page = folder / comparePage;
    const auto summary = compare(options, executor, progress);
    if (!summary) return summary.error();
    report::Section section{"What the micromaps take", {}};
    for (report::Section& states : comparisonSections(*summary, options)) {
        if (states.title == "4 states") section.blocks = std::move(states.blocks);
    }
    section.blocks.emplace_back(report::Links{{{comparePage, "the same with 2 states, and all figures"}}});
    return section;
}

Result<report::Section> squareDemo(const std::filesystem::path& scene, const std::filesystem::path& folder,
                                   const Executor& executor, ProgressSink& progress) {
    VqOptions options;
    options.inputs = {scene};
    options.outputFolder = folder / vqFolder;
    options.mapsPerTexture = 4;
    const auto summary = vq(options, executor, progress);
    if (!summary) return summary.error();
    report::Section section{"What opacity squares would save", {}};
    section.blocks.emplace_back(report::Paragraph{
        "Maps of squares over pairs of triangles, in 256 bits (VQ2) or 512 bits (VQ4) each."});
    section.blocks.emplace_back(vqTable(*summary));
    section.blocks.emplace_back(report::Links{
        {{"vq/index.html", "the curves, and the maps themselves before and after compression"}}});
    return section;
}

}  // namespace

Result<std::vector<report::Section>> measureDemo(const std::filesystem::path& scene,
                                                 const std::filesystem::path& folder,
                                                 const Executor& executor, ProgressSink& progress) {
    auto sizes = compareDemo(scene, folder, executor, progress);
    if (!sizes) return sizes.error();
    auto squares = squareDemo(scene, folder, executor, progress);
    if (!squares) return squares.error();
    return std::vector{std::move(*sizes), std::move(*squares)};
}

}  // namespace filigree::jobs
