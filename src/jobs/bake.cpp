#include "filigree/jobs/bake.h"

#include "filigree/io/gltf.h"
#include "filigree/io/gltf_write.h"

#include "jobs/json_text.h"
#include "jobs/micromap_files.h"
#include "jobs/stopwatch.h"

namespace filigree::jobs {
namespace {

// The scene's micromaps as the writers take them; looks into `scene`.
io::MicromapOutput outputOf(const scene::Scene& scene, bool rotated) {
    io::MicromapOutput output;
    for (const auto& micromaps : scene.micromaps) {
        output.micromaps.push_back({micromaps.name, &micromaps.set, *micromaps.bakedWith});
    }
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) {
            if (primitive.micromaps < 0) continue;
            auto& out = output.primitives.emplace_back();
            out.mesh = primitive.meshIndex;
            out.primitive = primitive.primitiveIndex;
            out.micromaps = static_cast<size_t>(primitive.micromaps);
            out.indices = primitive.micromapIndices;
            if (rotated) out.vertexIndices = primitive.indices;
        }
    }
    return output;
}

}  // namespace

Result<BakeSummary> bake(const BakeOptions& options, const Executor& executor, ProgressSink& progress) {
    if (auto checked = check(options.parameters); !checked) return checked.error();
    const Stopwatch total;
    auto document = io::GltfDocument::load(options.input);
    if (!document) return document.error();
    io::ReadOptions reading;
    reading.blendAlpha = options.parameters.includeBlend;
    reading.micromaps = false;
    auto scene = io::readScene(*document, reading);
    if (!scene) return scene.error();
    const double readSeconds = total.seconds();

    auto summary = bakeScene(*scene, options.parameters, executor, progress);
    if (!summary) return summary.error().within(options.input.string());
    summary->readSeconds = readSeconds;

    const Stopwatch writing;
    const auto output = outputOf(*scene, options.parameters.rotate);
    if (auto written = writeMicromapFiles(*document, output, options.output, options.rawFolder); !written)
        return written.error();
    summary->writeSeconds = writing.seconds();
    summary->totalSeconds = total.seconds();
    return summary;
}

std::string toJson(const BakeSummary& s) {
    Json levels = Json::object();
    for (size_t level = 0; level < s.levels.size(); ++level) {
        if (s.levels[level] > 0) levels[std::to_string(level)] = s.levels[level];
    }
    Json json = {
        {"triangles", s.triangles},
        {"masked_triangles", s.maskedTriangles},
        {"micromaps", s.micromaps},
        {"special",
         {{"transparent", s.special[0]},
          {"opaque", s.special[1]},
          {"unknown_transparent", s.special[2]},
          {"unknown_opaque", s.special[3]}}},
        {"levels", levels},
        {"bytes", {{"data", s.dataBytes}, {"records", s.recordBytes}, {"indices", s.indexBytes}}},
        {"micro_triangles", s.microTriangles},
        {"known_share", s.knownShare()},
        {"seconds",
         {{"read", s.readSeconds},
          {"bake", s.bakeSeconds},
          {"write", s.writeSeconds},
          {"total", s.totalSeconds}}},
    };
    if (s.budgetCost && s.budgetBound) json["budget"] = {{"cost", *s.budgetCost}, {"bound", *s.budgetBound}};
    return dump(json);
}

}  // namespace filigree::jobs
