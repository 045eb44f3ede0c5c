#include "filigree/jobs/validate.h"

#include "filigree/io/api_blob.h"
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

}  // namespace

Result<ValidateSummary> validate(const ValidateOptions& options, const Executor& executor,
                                 ProgressSink& progress) {
    if (!(options.sample > 0 && options.sample <= 1)) {
        return Error{ErrorKind::usage,
                     fmt::format("--sample {}: give a share above 0 and at most 1", options.sample)};
    }
    ValidateSummary summary;
    std::error_code ignored;
    const auto validated = std::filesystem::is_directory(options.input, ignored)
                               ? validateBlobs(options, summary)
                               : validateGltf(options, executor, progress, summary);
    if (!validated) return validated.error();
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
