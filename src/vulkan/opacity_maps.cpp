#include "vulkan/opacity_maps.h"

#include "vulkan/decoders.h"
#include "vulkan/scene_words.h"

#include <cassert>

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

// Squares: the map above four bits of place.
constexpr unsigned placeBits = 4;
constexpr uint32_t mostSquares = (1u << (32 - placeBits)) - 1;

Error wrongSurface(size_t surface, std::string_view what) {
    return {ErrorKind::format, fmt::format("surface {}: {}", surface, what)};
}

}  // namespace

Status checkSurfaces(const RayScene& scene, const Method& method, uint64_t mapCount) {
    for (size_t k = 0; k < method.surfaces.size(); ++k) {
        const SurfaceMaps& maps = method.surfaces[k];
        if (maps.texture && *maps.texture >= mapCount)
            return wrongSurface(k, fmt::format("no texture {}", *maps.texture));
        if (maps.indices.empty()) continue;
        const size_t triangles = scene.primitive(k).triangleCount();
        if (maps.indices.size() != triangles || (method.squares && maps.places.size() != triangles))
            return wrongSurface(k, fmt::format("{} maps for {} triangles", maps.indices.size(), triangles));
        for (const int32_t index : maps.indices) {
            if (index < -4 || index >= static_cast<int64_t>(mapCount))
                return wrongSurface(k, fmt::format("no map {}", index));
        }
    }
    return {};
}

namespace {

uint32_t entryOf(const Method& method, const SurfaceMaps& maps, size_t triangle) {
    const auto index = static_cast<uint32_t>(maps.indices[triangle]);
    if (maps.indices[triangle] < 0 || !method.squares) return index;
    const quadmap::SquarePlace place = maps.places[triangle];
    return index << placeBits | static_cast<uint32_t>(place.order) << 1 | static_cast<uint32_t>(place.half);
}

// Of each surface where its entries begin, then all entries.
std::vector<uint32_t> surfaceWords(const RayScene& scene, const Method& method) {
    std::vector<uint32_t> words(scene.surfaceCount(), noWord);
    for (size_t k = 0; k < method.surfaces.size(); ++k) {
        const SurfaceMaps& maps = method.surfaces[k];
        if (maps.texture) words[k] = *maps.texture;
        if (maps.indices.empty()) continue;
        words[k] = static_cast<uint32_t>(words.size());
        for (size_t t = 0; t < maps.indices.size(); ++t) words.push_back(entryOf(method, maps, t));
    }
    return words;
}

// The blocks that the decoder reads.
struct Blocks {
    std::span<const uint8_t> descriptors;
    std::span<const uint8_t> payload;
    uint64_t mapCount = 0;
};

Result<Blocks> describe(const Method& method, OpacityMaps& to) {
    if (method.set) {
        if (auto good = checkSet(*method.set); !good) return good.error();
        to.decoder = decoderOf(method.set->encoding);
        to.widthShift = widthShiftOf(method.set->format);
        return Blocks{method.set->descriptors, method.set->payload, method.set->mapCount};
    }
    if (!method.squares) return Blocks{};
    if (method.squares->mapCount() >= mostSquares)
        return Error{ErrorKind::limit, fmt::format("{} squares; shaders tell fewer than {} apart",
                                                   method.squares->mapCount(), mostSquares)};
    const auto decoder = decoderOf(method.squares->format());
    if (!decoder) return decoder.error();
    to.decoder = *decoder;
    return Blocks{{}, method.squares->bytes(), method.squares->mapCount()};
}

}  // namespace

Result<OpacityMaps> OpacityMaps::make(Device::Data& device, const RayScene& scene, const Method& method) {
    assert(method.surfaces.size() <= scene.surfaceCount() && !(method.set && method.squares));
    OpacityMaps made;
    const auto blocks = describe(method, made);
    if (!blocks) return blocks.error();
    if (auto good = checkSurfaces(scene, method, blocks->mapCount); !good) return good.error();
    auto descriptors = uploaded(device, blocks->descriptors, "descriptors");
    if (!descriptors) return descriptors.error();
    auto payload = uploaded(device, blocks->payload, "the payload");
    if (!payload) return payload.error();
    const auto words = surfaceWords(scene, method);
    made.bytes = blocks->descriptors.size() + blocks->payload.size();
    if (made.decoder != Decoder::none) made.bytes += 4 * words.size();
    auto surfaces = uploadedOf(device, words, "the triangles' maps");
    if (!surfaces) return surfaces.error();
    made.descriptors = std::move(*descriptors);
    made.payload = std::move(*payload);
    made.surfaces = std::move(*surfaces);
    return made;
}

}  // namespace filigree::vulkan
