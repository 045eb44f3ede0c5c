#include "filigree/quadmap/two_state.h"
#include "filigree/quadmap/vq2.h"
#include "filigree/quadmap/vq4.h"

#include "trace/accept.h"
#include "trace/opacity_data.h"
#include "trace/random.h"

#include <cassert>
#include <utility>

#include <fmt/format.h>

namespace filigree::trace {
namespace {

using quadmap::Half;
using quadmap::Region;
using quadmap::SquareFormat;
using quadmap::SquarePlace;
using quadmap::SquareReader;

// What a triangle says of its square: the map in the upper bits, order and half in the lowest four; or a
// special index, among the highest numbers.
constexpr unsigned placeBits = 4;
constexpr uint32_t firstSpecialEntry = ~3u;

constexpr uint32_t entryOf(int32_t index, SquarePlace place) {
    if (index < 0) return static_cast<uint32_t>(index);
    return static_cast<uint32_t>(index) << placeBits | static_cast<uint32_t>(place.order) << 1 |
           static_cast<uint32_t>(place.half);
}

struct SquareEntry {
    uint32_t entry;
    [[nodiscard]] bool isSpecial() const { return entry >= firstSpecialEntry; }
    [[nodiscard]] Region special() const {
        return entry == ~0u ? Region::transparent : entry == ~1u ? Region::opaque : Region::mixed;
    }
    [[nodiscard]] uint32_t map() const { return entry >> placeBits; }
    [[nodiscard]] SquarePlace place() const {
        return {static_cast<Half>(entry & 1), static_cast<uint8_t>(entry >> 1 & 7)};
    }
};

struct BySquare final : Opacity::Data {
    explicit BySquare(const SquareReader& r) : reader(r) {}
    SquareReader reader;
    std::vector<uint32_t> first;  // [surface_count], into `entries`; noIndices: every candidate is unknown
    std::vector<uint32_t> entries;
    [[nodiscard]] uint64_t indexBytes() const override {
        return sizeof(uint32_t) * (first.size() + entries.size());
    }
};

template <SquareFormat format>
constexpr unsigned formatSide =
    format == SquareFormat::vq4 || format == SquareFormat::vq4Plus ? quadmap::vq4Side : quadmap::vq2Side;

template <SquareFormat format>
Region regionAt(std::span<const uint8_t> block, quadmap::Cell cell) {
    if constexpr (format == SquareFormat::vq2)
        return quadmap::vq2Region(quadmap::Vq2View(block), cell.x, cell.y);
    else if constexpr (format == SquareFormat::vq2Plus)
        return quadmap::vq2PlusRegion(quadmap::Vq2View(block), cell.x, cell.y);
    else
        return quadmap::vq4Region(
            quadmap::Vq4View(block),
            format == SquareFormat::vq4 ? quadmap::Vq4Layout::vq4 : quadmap::Vq4Layout::vq4Plus, cell.x,
            cell.y);
}

// Mixed regions hit by chance, the same for each ray and place.
bool acceptByChance(const RayContext& context, const BySquare& opacity, const Candidate& candidate,
                    SquareEntry entry) {
    const uint32_t place = hashed(candidate.triangle, hashed(candidate.instance, candidate.surface->number));
    const uint32_t seed = hashed(context.seed, place);
    if (entry.isSpecial()) return quadmap::hashOf(candidate.u, candidate.v, seed) < 0.5F;
    const quadmap::HalfWeights at = quadmap::weightsIn(entry.place(), candidate.u, candidate.v);
    return quadmap::isHit(opacity.reader, entry.map(), entry.place().half, static_cast<float>(at.u),
                          static_cast<float>(at.v), quadmap::Neighbourhood::two, seed);
}

template <SquareFormat format>
bool acceptBySquare(RayContext& context, const Candidate& candidate) {
    const auto& opacity = *static_cast<const BySquare*>(context.opacity);
    ++context.counts->candidateHits;
    const uint32_t first = opacity.first[candidate.surface->number];
    if (first == noIndices) return acceptUnknown(context, candidate);
    const SquareEntry entry{opacity.entries[size_t{first} + candidate.triangle]};
    Region region = Region::mixed;
    if (entry.isSpecial()) {
        region = entry.special();
    } else {
        const quadmap::Cell cell =
            quadmap::regionOf(entry.place(), candidate.u, candidate.v, formatSide<format>);
        ++context.counts->lookups;
        if (context.countBitsRead) [[unlikely]]
            context.counts->bitsRead += opacity.reader.bitsRead(entry.map(), cell.x, cell.y);
        region = regionAt<format>(opacity.reader.block(entry.map()), cell);
    }
    if (quadmap::isKnown(region)) return region == Region::opaque;
    if (opacity.states == 2 || context.twoState) return acceptByChance(context, opacity, candidate, entry);
    return acceptUnknown(context, candidate);
}

AcceptFunction acceptFor(SquareFormat format) {
    switch (format) {
        case SquareFormat::vq2:
            return acceptBySquare<SquareFormat::vq2>;
        case SquareFormat::vq2Plus:
            return acceptBySquare<SquareFormat::vq2Plus>;
        case SquareFormat::vq4:
            return acceptBySquare<SquareFormat::vq4>;
        default:
            return acceptBySquare<SquareFormat::vq4Plus>;
    }
}

Status checkSquares(const World& world, const std::vector<SurfaceSquares>& surfaces, size_t mapCount) {
    if (surfaces.size() > world.surfaceCount())
        return Error{ErrorKind::format, fmt::format("squares for {} surfaces, the world has {}",
                                                    surfaces.size(), world.surfaceCount())};
    if (mapCount > firstSpecialEntry >> placeBits)
        return Error{ErrorKind::limit, fmt::format("{} squares, at most {} can be told apart", mapCount,
                                                   firstSpecialEntry >> placeBits)};
    for (size_t k = 0; k < surfaces.size(); ++k) {
        const auto& [indices, places] = surfaces[k];
        if (indices.empty()) continue;
        const size_t triangles = world.primitive(k).triangleCount();
        if (indices.size() != triangles || places.size() != triangles)
            return Error{ErrorKind::format,
                         fmt::format("surface {}: {} indices and {} places of squares for {} triangles", k,
                                     indices.size(), places.size(), triangles)};
        for (size_t t = 0; t < triangles; ++t) {
            if (indices[t] < -4 || indices[t] >= static_cast<int64_t>(mapCount))
                return Error{ErrorKind::format, fmt::format("surface {}: no square {}", k, indices[t])};
            if (places[t].order >= quadmap::squareOrders.size())
                return Error{ErrorKind::format,
                             fmt::format("surface {}: triangle {} has order {}, expected 0 to {}", k, t,
                                         places[t].order, quadmap::squareOrders.size() - 1)};
        }
    }
    return {};
}

}  // namespace

Result<Opacity> Opacity::make(Method method, unsigned states, const World& world, const SquareReader& squares,
                              const std::vector<SurfaceSquares>& surfaces) {
    assert(states == 2 || states == 4);
    if (squareFormatOf(method) != squares.format()) {
        return Error{ErrorKind::usage,
                     fmt::format("{} cannot read {}", nameOf(method), nameOf(squares.format()))};
    }
    if (auto checked = checkSquares(world, surfaces, squares.mapCount()); !checked) return checked.error();
    auto data = std::make_unique<BySquare>(squares);
    data->accepts = acceptFor(squares.format());
    data->method = method;
    data->states = states;
    data->setBytes = squares.mapCount() * blockBytesOf(squares.format());
    data->first.assign(world.surfaceCount(), noIndices);
    for (size_t k = 0; k < surfaces.size(); ++k) {
        const auto& [indices, places] = surfaces[k];
        if (!indices.empty()) data->first[k] = static_cast<uint32_t>(data->entries.size());
        for (size_t t = 0; t < indices.size(); ++t) data->entries.push_back(entryOf(indices[t], places[t]));
    }
    return Opacity(std::move(data));
}

}  // namespace filigree::trace
