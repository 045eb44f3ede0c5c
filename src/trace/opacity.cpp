#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/dag.h"
#include "filigree/encoding/flat.h"
#include "filigree/encoding/gruen.h"
#include "filigree/encoding/indexed_tree.h"
#include "filigree/encoding/sdag.h"
#include "filigree/encoding/tree.h"

#include "trace/opacity_data.h"

#include <array>
#include <cassert>
#include <utility>

#include <fmt/format.h>

namespace filigree::trace {
namespace {

using encoding::Encoding;
using micromap::State;

constexpr std::array<std::string_view, methodCount> names{
    "none", "texture", "bitmask", "gruen", "micromap", "tree", "indexed-tree", "dag", "sdag"};

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
struct WithReader final : Opacity::Data {
    explicit WithReader(Reader r) : reader(std::move(r)) {}
    Reader reader;
};

// No state decided: aside with it, or the texture does.
bool acceptUnknown(RayContext& context, const Candidate& candidate) {
    ++context.counts->unknown;
    if (context.deferred != nullptr && context.deferred->push(candidate)) return false;
    return fetchAccepts(context, candidate);
}

bool acceptState(RayContext& context, const Opacity::Data& opacity, const Candidate& candidate, State state) {
    if (micromap::isKnown(state) || opacity.states == 2 || context.twoState)
        return micromap::isOpaqueSide(state);
    return acceptUnknown(context, candidate);
}

template <class Reader>
bool acceptByMap(RayContext& context, const Candidate& candidate) {
    const auto& opacity = *static_cast<const WithReader<Reader>*>(context.opacity);
    ++context.counts->candidateHits;
    const SurfaceMaps& maps = opacity.surfaces[candidate.surface->number];
    if (maps.indices.empty()) return acceptUnknown(context, candidate);
    const int32_t index = maps.indices[candidate.triangle];
    if (index < 0) return acceptState(context, opacity, candidate, micromap::stateOfSpecialIndex(index));
    ++context.counts->lookups;
    const auto map = static_cast<uint32_t>(index);
    return acceptState(context, opacity, candidate, opacity.reader.at(map, candidate.u, candidate.v));
}

bool acceptByBitmask(RayContext& context, const Candidate& candidate) {
    const auto& opacity = *static_cast<const WithReader<encoding::BitmaskReader>*>(context.opacity);
    ++context.counts->candidateHits;
    const SurfaceMaps& maps = opacity.surfaces[candidate.surface->number];
    // Vertex alpha is in no bitmask.
    if (!maps.texture || !candidate.surface->primitive->alphas.empty())
        return acceptUnknown(context, candidate);
    ++context.counts->lookups;
    const mesh::Uv uv = candidate.surface->coordinatesAt(candidate.triangle, candidate.u, candidate.v);
    return acceptState(context, opacity, candidate, opacity.reader.at(*maps.texture, uv.u, uv.v));
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
MadeData withReader(const encoding::EncodedView& set, AcceptFunction accepts) {
    auto reader = Reader::open(set);
    if (!reader) return reader.error();
    std::unique_ptr<Opacity::Data> data = std::make_unique<WithReader<Reader>>(std::move(*reader));
    data->accepts = accepts;
    return data;
}

template <class Reader>
MadeData byMap(const encoding::EncodedView& set) {
    return withReader<Reader>(set, acceptByMap<Reader>);
}

MadeData withoutReader(AcceptFunction accepts) {
    auto data = std::make_unique<Opacity::Data>();
    data->accepts = accepts;
    return data;
}

MadeData dataOf(Method method, const encoding::EncodedView& set) {
    switch (method) {
        case Method::none:
            return withoutReader(acceptAll);
        case Method::texture:
            return withoutReader(acceptByTexture);
        case Method::bitmask:
            return withReader<encoding::BitmaskReader>(set, acceptByBitmask);
        case Method::gruen:
            return byMap<encoding::GruenReader>(set);
        case Method::micromap:
            return byMap<encoding::FlatReader>(set);
        case Method::tree:
            return byMap<encoding::TreeReader>(set);
        case Method::indexedTree:
            return byMap<encoding::IndexedTreeReader>(set);
        case Method::dag:
            return byMap<encoding::DagReader>(set);
        case Method::sdag:
            return byMap<encoding::SdagReader>(set);
    }
    return Error{ErrorKind::usage, "no such method"};
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
    if (method == Method::none || method == Method::texture) return std::nullopt;
    if (method == Method::micromap) return Encoding::flat;
    return encoding::encodingNamed(nameOf(method));
}

Result<Opacity> Opacity::make(Method method, unsigned states, const World& world,
                              const encoding::EncodedView& set, std::vector<SurfaceMaps> surfaces) {
    assert(states == 2 || states == 4);
    const auto wanted = encodingOf(method);
    if (wanted && set.encoding != *wanted) {
        return Error{ErrorKind::usage,
                     fmt::format("{} cannot read {}", nameOf(method), nameOf(set.encoding))};
    }
    auto data = dataOf(method, set);
    if (!data) return data.error();
    surfaces.resize(world.surfaceCount());
    if (auto checked = checkIndices(world, surfaces, set.mapCount); !checked) return checked.error();
    (*data)->method = method;
    (*data)->states = states;
    (*data)->surfaces = std::move(surfaces);
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

}  // namespace filigree::trace
