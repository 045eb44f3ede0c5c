#include "filigree/jobs/compress.h"

#include "filigree/io/fil.h"
#include "filigree/io/gltf.h"

#include "jobs/compress_squares.h"
#include "jobs/encode_scene.h"
#include "jobs/encoded_json.h"
#include "jobs/loss.h"
#include "jobs/peak_memory.h"
#include "jobs/scene_squares.h"
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

// Encodes the maps, with the loss that is allowed; `maps` are what is left then.
Result<OneBitSet> encodeAll(const CompressOptions& options, const scene::Scene& scene, SceneMaps& maps,
                            const LossyTarget& target, const Executor& executor, ProgressSink& progress,
                            CompressSummary& summary) {
    if (options.loss.oneBit) {
        LossyTarget sides = target;
        sides.options.maybeOpaque = false;  // the pairs say what a bit means
        return encodeOneBit(scene, maps, sides, executor, summary.oneBit.emplace());
    }
    auto set =
        options.loss.isLossy()
            ? encodeWithLoss(scene, maps, target, options.loss, executor, progress, summary.lossy.emplace())
            : encodeMaps(scene, maps, target.encoding, target.format, executor, target.options.aggregates);
    if (!set) return set.error();
    return OneBitSet{std::move(*set), {}};
}

Status write(const CompressOptions& options, const SceneMaps& maps, const OneBitSet& encoded,
             io::FilAsset asset, CompressSummary& summary) {
    const encoding::EncodedSet& set = encoded.set;
    const std::vector<int32_t> indices = allIndices(maps);
    io::FilContents contents;
    contents.meta = metaOf(maps, std::move(asset));
    contents.set = encoding::viewOf(set);
    contents.indices = indices;
    contents.pairs = encoded.pairs;
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
    if (const auto format = squareFormatNamed(options.encoding))
        return compressSquares(options, *format, executor, progress);
    const auto encoding = findEncoding(options.encoding);
    if (!encoding) return encoding.error();
    if (auto checked = check(options.loss, *encoding); !checked) return checked.error();
    if (options.aggregates && *encoding != encoding::Encoding::sdag)
        return Error{ErrorKind::usage, "--aggregates: is for sdag; dag always has them"};
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
    const micromap::Format format = formatFor(*maps, options, summary.baked);
    const LossyTarget target{*encoding, format, encodeOptions(*maps, format, options.aggregates)};
    const auto encoded = encodeAll(options, *scene, *maps, target, executor, progress, summary);
    if (!encoded && encoded.error().kind == ErrorKind::usage) return encoded.error();
    if (!encoded) return encoded.error().within(options.input.string());
    summary.encodeSeconds = encodingWatch.seconds();

    const Stopwatch writing;
    if (auto written = write(options, *maps, *encoded, std::move(*asset), summary); !written)
        return written.error();
    summary.writeSeconds = writing.seconds();
    summary.totalSeconds = total.seconds();
    summary.peakBytes = peakMemory();
    return summary;
}

namespace {

Json pointJson(const RatePoint& point, unsigned states) {
    Json json{{"bytes", point.bytes}, {states == 4 ? "extra_anyhit" : "changed_area", point.loss}};
    if (states == 4) json["known_share"] = point.knownShare;
    return json;
}

void addLoss(const CompressSummary& s, Json& json) {
    if (s.lossy) {
        json["lossy"] = pointJson(s.lossy->chosen, s.lossy->states);
        json["curve"] = Json::array();
        for (const RatePoint& point : s.lossy->curve)
            json["curve"].push_back(pointJson(point, s.lossy->states));
    }
    if (s.oneBit) {
        json["one_bit"] = {{"bytes", s.oneBit->bytes},
                           {"pair_bytes", s.oneBit->pairBytes},
                           {"maps",
                            {{"transparent_opaque", s.oneBit->maps[0]},
                             {"transparent_unknown", s.oneBit->maps[1]},
                             {"unknown_opaque", s.oneBit->maps[2]}}},
                           {"known_share", s.oneBit->knownShare},
                           {"two_state_bytes", s.oneBit->twoStateBytes},
                           {"four_state_bytes", s.oneBit->fourStateBytes},
                           {"four_state_known_share", s.oneBit->fourStateKnownShare}};
    }
}

}  // namespace

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
    addLoss(s, json);
    return dump(json);
}

}  // namespace filigree::jobs
