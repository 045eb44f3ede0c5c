#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/dag.h"
#include "filigree/encoding/flat.h"
#include "filigree/encoding/gruen.h"
#include "filigree/encoding/indexed_tree.h"
#include "filigree/encoding/sdag.h"
#include "filigree/encoding/tree.h"

#include "trace/accept.h"
#include "trace/opacity_data.h"

#include <array>
#include <cassert>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace filigree::trace {
namespace {

using encoding::Encoding;
using micromap::State;

constexpr std::array<std::string_view, methodCount> names{
    "none", "texture", "bitmask", "gruen", "micromap", "tree", "indexed-tree",
    "dag",  "sdag",    "vq2",     "vq4",   "vq2+",     "vq4+"};

bool acceptAll(RayContext& context, const Candidate&) {
    ++context.counts->candidateHits;
    return true;
}

bool acceptByTexture(RayContext& context, const Candidate& candidate) {
    ++context.counts->candidateHits;
    return fetchAccepts(context, candidate);
}

// A method with a reader of its encoding.
template <class Reader>
struct WithReader : Opacity::Data {
    explicit WithReader(Reader r) : reader(std::move(r)) {}
    Reader reader;
};

// Special indices are the highest numbers.
template <class Index>
constexpr auto firstSpecial = static_cast<Index>(0 - 4);

constexpr unsigned manyLevels = ~0u;

// What a candidate's triangle says of its map, as narrow as the number of maps allows: `indices` of all
// surfaces one after another.
template <class Reader, class Index>
struct ByMap final : WithReader<Reader> {
    using WithReader<Reader>::WithReader;

    std::vector<uint32_t> first;  // [surface_count], into `indices`; noIndices: every candidate is unknown
    std::vector<Index> indices;
    unsigned level = manyLevels;  // of all maps

    [[nodiscard]] State at(uint32_t map, float u, float v) const {
        // Then the place of a point need not wait for the map's descriptor.
        if (hasCurve && level != manyLevels) [[likely]]
            return this->reader.at(map, micromap::barycentricsToIndex(u, v, level));
        return this->reader.at(map, u, v);
    }

    [[nodiscard]] uint64_t bitsRead(uint32_t map, float u, float v) const {
        return this->reader.bitsRead(map, micromap::barycentricsToIndex(u, v, this->reader.level(map)));
    }

    // The others find points in their own ways.
    static constexpr bool hasCurve =
        !std::is_same_v<Reader, encoding::GruenReader> && !std::is_same_v<Reader, encoding::SdagReader>;

    [[nodiscard]] uint64_t indexBytes() const override {
        return first.size() * sizeof(uint32_t) + indices.size() * sizeof(Index);
    }
};

template <class Reader, class Index>
bool acceptByMap(RayContext& context, const Candidate& candidate) {
    const auto& opacity = *static_cast<const ByMap<Reader, Index>*>(context.opacity);
    ++context.counts->candidateHits;
    const uint32_t first = opacity.first[candidate.surface->number];
    if (first == noIndices) return acceptUnknown(context, candidate);
    const Index index = opacity.indices[size_t{first} + candidate.triangle];
    if (index >= firstSpecial<Index>) {
        const auto special = static_cast<int32_t>(static_cast<std::make_signed_t<Index>>(index));
        return acceptState(context, opacity, candidate, micromap::stateOfSpecialIndex(special));
    }
    ++context.counts->lookups;
    if (context.countBitsRead) [[unlikely]]
        context.counts->bitsRead += opacity.bitsRead(index, candidate.u, candidate.v);
    return acceptState(context, opacity, candidate, opacity.at(index, candidate.u, candidate.v));
}

struct ByBitmask final : WithReader<encoding::BitmaskReader> {
    using WithReader::WithReader;
    std::vector<uint32_t> textures;  // [surface_count], noIndices: every candidate is unknown
    [[nodiscard]] uint64_t indexBytes() const override { return textures.size() * sizeof(uint32_t); }
};

bool acceptByBitmask(RayContext& context, const Candidate& candidate) {
    const auto& opacity = *static_cast<const ByBitmask*>(context.opacity);
    const Surface& surface = *candidate.surface;
    ++context.counts->candidateHits;
    const uint32_t texture = opacity.textures[surface.number];
    // Vertex alpha is in no bitmask.
    if (texture == noIndices || surface.vertexAlphas != nullptr) return acceptUnknown(context, candidate);
    ++context.counts->lookups;
    if (context.countBitsRead) [[unlikely]]
        context.counts->bitsRead += opacity.reader.bitsRead();
    const mesh::Uv uv = surface.coordinatesAt(candidate.triangle, candidate.u, candidate.v);
    return acceptState(context, opacity, candidate, opacity.reader.at(texture, uv.u, uv.v));
}

Status checkIndices(const World& world, const std::vector<SurfaceMaps>& surfaces, uint32_t mapCount) {
    for (size_t k = 0; k < surfaces.size(); ++k) {
        const auto& maps = surfaces[k];
        if (maps.texture && *maps.texture >= mapCount) {
            return Error{ErrorKind::format, fmt::format("surface {}: no texture {}", k, *maps.texture)};
        }
        if (maps.indices.empty()) continue;
        if (maps.indices.size() != world.primitive(k).triangleCount()) {
            return Error{ErrorKind::format,
                         fmt::format("surface {}: {} micromap indices for {} triangles", k,
                                     maps.indices.size(), world.primitive(k).triangleCount())};
        }
        for (const int32_t index : maps.indices) {
            if (index < -4 || (index >= 0 && static_cast<uint32_t>(index) >= mapCount)) {
                return Error{ErrorKind::format, fmt::format("surface {}: no micromap {}", k, index)};
            }
        }
    }
    return {};
}

using MadeData = Result<std::unique_ptr<Opacity::Data>>;

template <class Reader>
unsigned commonLevel(const Reader& reader) {
    for (uint32_t map = 1; map < reader.mapCount(); ++map) {
        if (reader.level(map) != reader.level(0)) return manyLevels;
    }
    return reader.mapCount() == 0 ? manyLevels : reader.level(0);
}

template <class Reader, class Index>
std::unique_ptr<Opacity::Data> byMap(Reader reader, const std::vector<SurfaceMaps>& surfaces) {
    auto data = std::make_unique<ByMap<Reader, Index>>(std::move(reader));
    data->accepts = acceptByMap<Reader, Index>;
    data->level = commonLevel(data->reader);
    for (const SurfaceMaps& maps : surfaces) {
        const auto first = static_cast<uint32_t>(data->indices.size());
        data->first.push_back(maps.indices.empty() ? noIndices : first);
        for (const int32_t index : maps.indices) data->indices.push_back(static_cast<Index>(index));
    }
    return data;
}

template <class Reader>
MadeData byMap(const encoding::EncodedView& set, const std::vector<SurfaceMaps>& surfaces) {
    auto reader = Reader::open(set);
    if (!reader) return reader.error();
    if (set.mapCount <= firstSpecial<uint8_t>) return byMap<Reader, uint8_t>(std::move(*reader), surfaces);
    if (set.mapCount <= firstSpecial<uint16_t>) return byMap<Reader, uint16_t>(std::move(*reader), surfaces);
    return byMap<Reader, uint32_t>(std::move(*reader), surfaces);
}

MadeData byBitmask(const encoding::EncodedView& set, const std::vector<SurfaceMaps>& surfaces) {
    auto reader = encoding::BitmaskReader::open(set);
    if (!reader) return reader.error();
    auto data = std::make_unique<ByBitmask>(std::move(*reader));
    data->accepts = acceptByBitmask;
    for (const SurfaceMaps& maps : surfaces) data->textures.push_back(maps.texture.value_or(noIndices));
    return std::unique_ptr<Opacity::Data>(std::move(data));
}

MadeData withoutReader(AcceptFunction accepts) {
    auto data = std::make_unique<Opacity::Data>();
    data->accepts = accepts;
    return data;
}

MadeData dataOf(Method method, const encoding::EncodedView& set, const std::vector<SurfaceMaps>& surfaces) {
    switch (method) {
        case Method::none:
            return withoutReader(acceptAll);
        case Method::texture:
            return withoutReader(acceptByTexture);
        case Method::bitmask:
            return byBitmask(set, surfaces);
        case Method::gruen:
            return byMap<encoding::GruenReader>(set, surfaces);
        case Method::micromap:
            return byMap<encoding::FlatReader>(set, surfaces);
        case Method::tree:
            return byMap<encoding::TreeReader>(set, surfaces);
        case Method::indexedTree:
            return byMap<encoding::IndexedTreeReader>(set, surfaces);
        case Method::dag:
            return byMap<encoding::DagReader>(set, surfaces);
        case Method::sdag:
            return byMap<encoding::SdagReader>(set, surfaces);
        case Method::vq2:
        case Method::vq4:
        case Method::vq2Plus:
        case Method::vq4Plus:
            break;
    }
    return Error{ErrorKind::usage, fmt::format("{} reads squares, not micromaps", nameOf(method))};
}

}  // namespace

std::string_view nameOf(Method method) {
    return names[static_cast<size_t>(method)];
}

std::optional<Method> methodNamed(std::string_view name) {
    for (size_t k = 0; k < names.size(); ++k) {
        if (names[k] == name) return static_cast<Method>(k);
    }
    return std::nullopt;
}

std::optional<Encoding> encodingOf(Method method) {
    if (method == Method::none || method == Method::texture || squareFormatOf(method)) return std::nullopt;
    if (method == Method::micromap) return Encoding::flat;
    return encoding::encodingNamed(nameOf(method));
}

std::optional<quadmap::SquareFormat> squareFormatOf(Method method) {
    for (unsigned k = 0; k < quadmap::squareFormatCount; ++k) {
        const auto format = static_cast<quadmap::SquareFormat>(k);
        if (nameOf(format) == nameOf(method)) return format;
    }
    return std::nullopt;
}

Result<Opacity> Opacity::make(Method method, unsigned states, const World& world,
                              const encoding::EncodedView& set, std::vector<SurfaceMaps> surfaces) {
    assert(states == 2 || states == 4);
    const auto wanted = encodingOf(method);
    if (wanted && set.encoding != *wanted) {
        return Error{ErrorKind::usage,
                     fmt::format("{} cannot read {}", nameOf(method), nameOf(set.encoding))};
    }
    surfaces.resize(world.surfaceCount());
    if (wanted) {
        if (auto checked = checkIndices(world, surfaces, set.mapCount); !checked) return checked.error();
    }
    auto data = dataOf(method, set, surfaces);
    if (!data) return data.error();
    (*data)->method = method;
    (*data)->states = states;
    if (wanted) (*data)->setBytes = set.descriptors.size() + set.payload.size();
    return Opacity(std::move(*data));
}

Opacity::Opacity(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Opacity::Opacity(Opacity&&) noexcept = default;
Opacity& Opacity::operator=(Opacity&&) noexcept = default;
Opacity::~Opacity() = default;

Method Opacity::method() const {
    return data_->method;
}
unsigned Opacity::states() const {
    return data_->states;
}

uint64_t Opacity::bytes() const {
    return data_->setBytes + data_->indexBytes();
}

}  // namespace filigree::trace
