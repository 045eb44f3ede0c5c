#include "filigree/jobs/validate.h"

#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/map_reader.h"
#include "filigree/encoding/one_bit.h"
#include "filigree/io/api_blob.h"
#include "filigree/io/fil.h"
#include "filigree/io/fil_grids.h"
#include "filigree/io/fil_squares.h"
#include "filigree/io/gltf.h"
#include "filigree/io/gltf_rules.h"

#include "jobs/deep.h"
#include "jobs/json_text.h"

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

Status validateGltf(const ValidateOptions& options, const Executor& executor, ProgressSink& progress,
                    ValidateSummary& summary) {
    const auto document = io::GltfDocument::load(options.input);
    if (!document) return document.error();
    summary.breaches = io::checkRules(*document);
    if (!options.deep) return {};
    io::ReadOptions reading;
    reading.blendAlpha = true;
    auto scene = io::readScene(*document, reading);
    if (!scene) {
        if (summary.breaches.empty()) return scene.error();
        summary.notes.push_back("not examined in depth: " + scene.error().message);
        return {};
    }
    return validateDeep(*scene, options.sample, executor, progress, summary);
}

Status validateBlobs(const ValidateOptions& options, ValidateSummary& summary) {
    auto breaches = io::checkApiBlobs(options.input);
    if (!breaches) return breaches.error();
    summary.breaches = std::move(*breaches);
    if (options.deep)
        summary.notes.push_back("blobs name no texture; examine the glTF file in depth instead");
    return {};
}

// The breach of what a reader refused; what could not be read at all stays an error.
Status refused(const Error& error, const std::string& path, const std::string& rule,
               ValidateSummary& summary) {
    if (error.kind != ErrorKind::format) return error;
    summary.breaches.push_back({path, rule, error.message});
    return {};
}

Status validateSquares(const ValidateOptions& options, ValidateSummary& summary) {
    if (options.deep) summary.notes.push_back("a .fil of squares is checked by its rules alone");
    const auto file = io::FilSquareFile::read(options.input);
    return file ? Status() : refused(file.error(), "container", "fil-container", summary);
}

Status validateGrids(const ValidateOptions& options, const Executor& executor, ValidateSummary& summary) {
    if (options.deep) summary.notes.push_back("a .fil of grids is checked by its rules alone");
    const auto file = io::readFilGrids(options.input, executor);
    return file ? Status() : refused(file.error(), "grids", "fil-grids", summary);
}

Status validateFil(const ValidateOptions& options, const Executor& executor, ValidateSummary& summary) {
    if (io::gridsIn(options.input)) return validateGrids(options, executor, summary);
    if (io::squaresIn(options.input)) return validateSquares(options, summary);
    const auto file = io::FilFile::read(options.input);
    if (!file) return refused(file.error(), "container", "fil-container", summary);
    if (options.deep)
        summary.notes.push_back("a .fil names no texture; expand it and examine that in depth instead");
    const encoding::EncodedView& set = file->set();
    const std::string name(encoding::nameOf(set.encoding));
    if (set.encoding == encoding::Encoding::bitmask) {
        const auto reader = encoding::BitmaskReader::open(set);
        return reader ? Status() : refused(reader.error(), name, "fil-set", summary);
    }
    const auto reader = encoding::openReader(set);
    if (!reader) return refused(reader.error(), name, "fil-set", summary);
    if (!file->pairs().empty()) {
        const auto pairs = encoding::PairReader::open(set, file->pairs());
        if (!pairs) return refused(pairs.error(), name, "fil-set", summary);
    }
    const auto level = file->meta().level;
    for (uint32_t map = 0; level && map < set.mapCount; ++map) {
        if ((*reader)->level(map) == *level) continue;
        summary.breaches.push_back({name, "fil-level",
                                    fmt::format("map {} has level {}, the meta section says {}", map,
                                                (*reader)->level(map), *level)});
        break;
    }
    return {};
}

Status validateFile(const ValidateOptions& options, const Executor& executor, ProgressSink& progress,
                    ValidateSummary& summary) {
    std::error_code ignored;
    if (std::filesystem::is_directory(options.input, ignored)) return validateBlobs(options, summary);
    if (io::isFil(options.input)) return validateFil(options, executor, summary);
    return validateGltf(options, executor, progress, summary);
}

}  // namespace

Result<ValidateSummary> validate(const ValidateOptions& options, const Executor& executor,
                                 ProgressSink& progress) {
    if (!(options.sample > 0 && options.sample <= 1)) {
        return Error{ErrorKind::usage,
                     fmt::format("--sample {}: give a share above 0 and at most 1", options.sample)};
    }
    ValidateSummary summary;
    if (const Status validated = validateFile(options, executor, progress, summary); !validated)
        return validated.error();
    return summary;
}

std::string toJson(const ValidateSummary& s) {
    Json breaches = Json::array();
    for (const auto& breach : s.breaches) {
        breaches.push_back({{"path", breach.path}, {"rule", breach.rule}, {"message", breach.message}});
    }
    Json json = {{"valid", s.valid()}, {"breaches", breaches}};
    if (s.deep) {
        json["deep"] = {{"micro_triangles", s.deep->microTriangles},
                        {"wrong", s.deep->wrong},
                        {"over_cautious", s.deep->overCautious},
                        {"uncertain", s.deep->uncertain}};
    }
    return dump(json);
}

}  // namespace filigree::jobs
