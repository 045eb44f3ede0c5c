#include "filigree/jobs/vq.h"

#include "filigree/core/file.h"

#include "jobs/inspection.h"
#include "jobs/one_stage.h"
#include "jobs/stopwatch.h"
#include "jobs/vq_maps.h"
#include "jobs/vq_measure.h"
#include "jobs/vq_picture.h"
#include "jobs/vq_report.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

Status check(const VqOptions& options) {
    if (options.inputs.empty()) return Error{ErrorKind::usage, "expected textures or scenes"};
    if (options.prefer != 0 && options.prefer != 'T' && options.prefer != 'O')
        return Error{ErrorKind::usage, "--prefer: expected T or O"};
    if (options.cutoff && !(*options.cutoff >= 0 && *options.cutoff <= 1))
        return Error{ErrorKind::usage, fmt::format("--cutoff {}: expected 0 to 1", *options.cutoff)};
    if (!(options.guard >= 0) || !std::isfinite(options.guard))
        return Error{ErrorKind::usage, fmt::format("--guard {}: expected 0 or more texels", options.guard)};
    return {};
}

bool isScene(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return extension == ".glb" || extension == ".gltf";
}

struct Finished {
    VqTexture texture;
    ChosenTransforms transforms;
    std::optional<VqPicture> picture;
};

class Run {
  public:
    Run(const VqOptions& options, const Executor& executor) : options_(options), executor_(executor) {}

    // Measures the textures that stand in files of their own side by side.
    Status addTextures(const std::vector<std::filesystem::path>& paths, ProgressSink& progress) {
        OneStage stage(progress, "encode", paths.size(), "textures");
        std::vector<std::optional<Result<Finished>>> finished(paths.size());
        const size_t first = finished_.size();
        executor_.parallelFor(paths.size(), 1, [&](size_t begin, size_t end) {
            for (size_t k = begin; k < end; ++k) {
                auto input = readVqTexture(paths[k], options_);
                finished[k] = input ? finish(*input, first + k, stage) : Result<Finished>(input.error());
            }
        });
        for (auto& texture : finished) {
            if (!*texture) return texture->error();
            finished_.push_back(std::move(**texture));
        }
        return {};
    }

    Status addScene(const std::filesystem::path& path, ProgressSink& progress) {
        auto inputs = readVqScene(path, options_, notes_);
        if (!inputs) return inputs.error();
        if (options_.limit > 0 && inputs->size() > left()) inputs->resize(left());
        size_t maps = 0;
        for (const VqInput& input : *inputs) maps += input.maps();
        OneStage stage(progress, "encode", maps, "maps");
        for (const VqInput& input : *inputs) {
            auto finished = finish(input, finished_.size(), stage);
            if (!finished) return finished.error().within(path.string());
            finished_.push_back(std::move(*finished));
        }
        return {};
    }

    // How many textures the limit still allows.
    [[nodiscard]] size_t left() const {
        if (options_.limit == 0) return SIZE_MAX;
        return options_.limit - std::min(options_.limit, finished_.size());
    }

    VqSummary summary(std::vector<VqPicture>& pictures) {
        VqSummary summary;
        ChosenTransforms chosen;
        for (Finished& finished : finished_) {
            summary.totals.add(finished.texture.totals);
            chosen.vq2.insert(chosen.vq2.end(), finished.transforms.vq2.begin(),
                              finished.transforms.vq2.end());
            chosen.vq4.insert(chosen.vq4.end(), finished.transforms.vq4.begin(),
                              finished.transforms.vq4.end());
            if (finished.picture) pictures.push_back(std::move(*finished.picture));
            summary.textures.push_back(std::move(finished.texture));
        }
        summary.vq2 = transformUseOf(chosen.vq2);
        summary.vq4 = transformUseOf(chosen.vq4);
        summary.notes = std::move(notes_);
        return summary;
    }

  private:
    Result<Finished> finish(const VqInput& input, size_t number, ProgressSink& progress) const {
        auto measured = measure(input, options_, executor_, progress);
        if (!measured) return measured.error();
        Finished finished{std::move(measured->texture), std::move(measured->transforms), {}};
        if (!options_.pictures) return finished;
        const VqPanels panels = drawPanels(input, measured->first);
        auto png = drawSheet(panels).png();
        if (!png) return png.error();
        auto item = galleryItem(finished.texture, panels);
        if (!item) return item.error();
        const std::string file = fmt::format("map-{:03}-{}.png", number + 1, plainName(input.name));
        finished.picture = VqPicture{file, std::move(*png), std::move(*item)};
        return finished;
    }

    const VqOptions& options_;
    const Executor& executor_;
    std::vector<Finished> finished_;
    std::vector<std::string> notes_;
};

// Measures the inputs in their order, textures that follow each other together.
Status addAll(const VqOptions& options, Run& run, ProgressSink& progress) {
    std::vector<std::filesystem::path> textures;
    const auto flush = [&]() -> Status {
        textures.resize(std::min(textures.size(), run.left()));
        auto added = run.addTextures(textures, progress);
        textures.clear();
        return added;
    };
    for (const std::filesystem::path& input : options.inputs) {
        if (!isScene(input)) {
            textures.push_back(input);
            continue;
        }
        if (auto added = flush(); !added) return added;
        if (auto added = run.addScene(input, progress); !added) return added;
    }
    return flush();
}

// Nothing is written before all is known, so that an error leaves nothing.
Status writeAll(const VqOptions& options, const VqSummary& summary, const std::vector<VqPicture>& pictures) {
    if (auto made = makeFolder(options.outputFolder); !made) return made;
    for (const VqPicture& picture : pictures) {
        if (auto written = writeFile(options.outputFolder / picture.file, picture.png); !written)
            return written;
    }
    return writeVqReport(options, summary, pictures);
}

}  // namespace

Result<VqSummary> vq(const VqOptions& options, const Executor& executor, ProgressSink& progress) {
    if (auto checked = check(options); !checked) return checked.error();
    const Stopwatch watch;
    Run run(options, executor);
    if (auto added = addAll(options, run, progress); !added) return added.error();
    std::vector<VqPicture> pictures;
    VqSummary summary = run.summary(pictures);
    summary.seconds = watch.seconds();
    if (auto written = writeAll(options, summary, pictures); !written) return written.error();
    return summary;
}

}  // namespace filigree::jobs
