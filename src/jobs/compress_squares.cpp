#include "jobs/compress_squares.h"

#include "filigree/io/fil_squares.h"
#include "filigree/io/gltf.h"

#include "jobs/peak_memory.h"
#include "jobs/scene_squares.h"
#include "jobs/stopwatch.h"

#include <string>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

// Options that are for micromaps alone.
Status check(const CompressOptions& options) {
    const auto refused = [&](const char* option) -> Status {
        return Error{ErrorKind::usage,
                     fmt::format("{}: is for micromaps, not for --encoding {}", option, options.encoding)};
    };
    if (options.parameters.level) return refused("--level");
    if (options.parameters.states != 4) return refused("--states");
    if (options.aggregates) return refused("--aggregates");
    if (options.loss.maxBytes) return refused("--max-bytes");
    if (options.loss.maxExtraAnyhit) return refused("--max-extra-anyhit");
    if (options.loss.maxChangedArea) return refused("--max-changed-area");
    if (options.loss.oneBit) return refused("--one-bit");
    return {};
}

Result<scene::Scene> readInput(const CompressOptions& options) {
    const auto document = io::GltfDocument::load(options.input);
    if (!document) return document.error();
    io::ReadOptions reading;
    reading.blendAlpha = options.parameters.includeBlend;
    reading.micromaps = false;
    return io::readScene(*document, reading);
}

uint64_t trianglesOf(const scene::Scene& scene) {
    uint64_t count = 0;
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) count += primitive.triangleCount();
    }
    return count;
}

EncodedSize sizeOf(const SceneSquares& squares) {
    EncodedSize size;
    size.encoding = quadmap::nameOf(squares.format);
    size.states = 3;
    size.maps = squares.maps();
    size.payloadBytes = squares.blocks.size();
    size.descriptorBytes = (squares.places.size() + 1) / 2;
    return size;
}

}  // namespace

Result<CompressSummary> compressSquares(const CompressOptions& options, quadmap::SquareFormat format,
                                        const Executor& executor, ProgressSink& progress) {
    if (auto checked = check(options); !checked) return checked.error();
    const Stopwatch total;
    CompressSummary summary;
    summary.baked = true;
    auto asset = io::identifyAsset(options.input);
    if (!asset) return asset.error();
    auto scene = readInput(options);
    if (!scene) return scene.error();
    summary.readSeconds = total.seconds();
    const Stopwatch pairing;
    const auto groups = pairGroups(*scene, options.parameters);
    summary.bakeSeconds = pairing.seconds();

    const Stopwatch encoding;
    auto squares = encodeSquares(*scene, groups, format, executor, progress);
    if (!squares) return squares.error().within(options.input.string());
    summary.notes = scene->notes;
    summary.triangles = trianglesOf(*scene);
    summary.maskedTriangles = squares->indices.size();
    summary.size = sizeOf(*squares);
    summary.encodeSeconds = encoding.seconds();

    const Stopwatch writing;
    squares->meta.asset = std::move(*asset);
    const auto maps = static_cast<uint32_t>(squares->maps());
    summary.indexBytes = io::filIndexBytes({}, maps, squares->indices.size());
    const auto bytes = io::writeFilSquares(
        options.output, {squares->meta, format, squares->indices, squares->places, squares->blocks},
        options.zstd);
    if (!bytes) return bytes.error();
    summary.fileBytes = *bytes;
    summary.writeSeconds = writing.seconds();
    summary.totalSeconds = total.seconds();
    summary.peakBytes = peakMemory();
    return summary;
}

}  // namespace filigree::jobs
