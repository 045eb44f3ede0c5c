#include "filigree/jobs/compress.h"

#include "filigree/io/fil.h"
#include "filigree/io/gltf.h"

#include "jobs/encode_scene.h"
#include "jobs/encoded_json.h"
#include "jobs/peak_memory.h"
#include "jobs/stopwatch.h"

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

Result<scene::Scene> readInput(const CompressOptions& options, encoding::Encoding encoding) {
    const auto document = io::GltfDocument::load(options.input);
    if (!document) return document.error();
    io::ReadOptions reading;
    reading.blendAlpha = options.parameters.includeBlend;
    reading.micromaps = !options.bakeAnew && encoding != encoding::Encoding::bitmask;
    return io::readScene(*document, reading);
}

// What is left of the maps where textures are encoded in their place.
void asTextures(SceneMaps& maps) {
    maps.level.reset();
    for (MapPrimitive& primitive : maps.primitives) primitive.indices.clear();
    if (const uint64_t count = vertexAlphaTriangles(maps); count > 0)
        maps.notes.push_back(fmt::format(
            "triangles with a vertex alpha, which no bitmask knows and which must not be looked up: {}",
            count));
}

Result<SceneMaps> mapsOf(scene::Scene& scene, encoding::Encoding encoding, const CompressOptions& options,
                         const Executor& executor, ProgressSink& progress) {
    if (!scene.micromaps.empty()) return carriedMaps(scene);
    auto maps = bakeMaps(scene, parametersFor(encoding, options.parameters), executor, progress);
    if (!maps) return maps.error().within(options.input.string());
    if (encoding == encoding::Encoding::bitmask) asTextures(*maps);
    return maps;
}

// The format to encode in: the one asked for, or that of micromaps which the scene carries.
micromap::Format formatFor(const SceneMaps& maps, const CompressOptions& options, bool baked) {
    if (!baked) return maps.format;
    return options.parameters.states == 2 ? micromap::Format::twoState : micromap::Format::fourState;
}

io::FilMeta metaOf(const SceneMaps& maps, io::FilAsset asset) {
    io::FilMeta meta;
    meta.asset = std::move(asset);
    meta.level = maps.level;
    for (const MapGroup& group : maps.groups) meta.groups.push_back({group.name, group.test});
    for (const MapPrimitive& p : maps.primitives) {
        meta.primitives.push_back({p.primitive->meshIndex, p.primitive->primitiveIndex,
                                   static_cast<uint32_t>(p.primitive->triangleCount()),
                                   static_cast<uint32_t>(p.group)});
    }
    return meta;
}

Status write(const CompressOptions& options, const SceneMaps& maps, const encoding::EncodedSet& set,
             io::FilAsset asset, CompressSummary& summary) {
    const std::vector<int32_t> indices = allIndices(maps);
    io::FilContents contents;
    contents.meta = metaOf(maps, std::move(asset));
    contents.set = encoding::viewOf(set);
    contents.indices = indices;
    summary.size = sizeOf(contents.set, maps.level);
    summary.indexBytes = io::filIndexBytes(set.encoding, set.mapCount, indices.size());
    auto bytes = io::writeFil(options.output, contents, options.zstd);
    if (!bytes) return bytes.error();
    summary.fileBytes = *bytes;
    return {};
}

}  // namespace

Result<CompressSummary> compress(const CompressOptions& options, const Executor& executor,
                                 ProgressSink& progress) {
    if (auto checked = check(options.parameters); !checked) return checked.error();
    const auto encoding = findEncoding(options.encoding);
    if (!encoding) return encoding.error();
    const Stopwatch total;
    CompressSummary summary;
    auto asset = io::identifyAsset(options.input);
    if (!asset) return asset.error();
    auto scene = readInput(options, *encoding);
    if (!scene) return scene.error();
    summary.readSeconds = total.seconds();

    const Stopwatch baking;
    summary.baked = scene->micromaps.empty();
    auto maps = mapsOf(*scene, *encoding, options, executor, progress);
    if (!maps) return maps.error();
    summary.notes = std::move(maps->notes);
    summary.triangles = maps->triangles;
    summary.maskedTriangles = maps->maskedTriangles;
    summary.bakeSeconds = baking.seconds();

    const Stopwatch encodingWatch;
    const auto set = encodeMaps(*scene, *maps, *encoding, formatFor(*maps, options, summary.baked), executor);
    if (!set) return set.error().within(options.input.string());
    summary.encodeSeconds = encodingWatch.seconds();

    const Stopwatch writing;
    if (auto written = write(options, *maps, *set, std::move(*asset), summary); !written)
        return written.error();
    summary.writeSeconds = writing.seconds();
    summary.totalSeconds = total.seconds();
    summary.peakBytes = peakMemory();
    return summary;
}

std::string toJson(const CompressSummary& s) {
    Json json = encodedJson(s.size, s.totalSeconds, s.peakBytes);
    json["triangles"] = s.triangles;
    json["masked_triangles"] = s.maskedTriangles;
    json["index_bytes"] = s.indexBytes;
    json["file_bytes"] = s.fileBytes;
    json["stage_seconds"] = {{"read", s.readSeconds},
                             {"bake", s.bakeSeconds},
                             {"encode", s.encodeSeconds},
                             {"write", s.writeSeconds}};
    return dump(json);
}

}  // namespace filigree::jobs
