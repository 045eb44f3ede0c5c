#include "filigree/vulkan/lookup.h"

#include "vulkan/decoders.h"
#include "vulkan/lookup_run.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace filigree::vulkan {
namespace {

// As lookup.comp has it.
struct Query {
    uint32_t map = 0;
    float u = 0;
    float v = 0;
};

// All that one run of the shader needs.
struct Lookups {
    Decoder decoder = Decoder::flat;
    uint32_t widthShift = 0;
    std::span<const uint8_t> descriptors;
    std::span<const uint8_t> payload;
    std::vector<Query> queries;
};

Status runLookups(Device::Data& device, const Lookups& lookups, std::vector<uint32_t>& found) {
    const std::array constants{lookups.widthShift};
    auto kernel = Kernel::make(device, {ShaderKind::lookup, lookups.decoder}, {4, sizeof(LookupRange), false},
                               constants);
    if (!kernel) return kernel.error();
    const auto descriptors = uploaded(device, lookups.descriptors, "descriptors");
    if (!descriptors) return descriptors.error();
    const auto payload = uploaded(device, lookups.payload, "the payload");
    if (!payload) return payload.error();
    const auto queries = uploadedOf(device, lookups.queries, "lookups");
    if (!queries) return queries.error();
    kernel->bindings().bind(0, *descriptors);
    kernel->bindings().bind(1, *payload);
    kernel->bindings().bind(2, *queries);
    return answerQueries(device, *kernel, 3, found.size(), "look states up",
                         {reinterpret_cast<uint8_t*>(found.data()), found.size() * sizeof(uint32_t)});
}

template <class State>
Result<std::vector<State>> statesOf(Device::Data& device, const Lookups& lookups) {
    std::vector<uint32_t> found(lookups.queries.size());
    if (found.empty()) return std::vector<State>();
    if (auto ran = runLookups(device, lookups, found); !ran) return ran.error();
    std::vector<State> states(found.size());
    std::ranges::transform(found, states.begin(), [](uint32_t state) { return static_cast<State>(state); });
    return states;
}

}  // namespace

Result<std::vector<micromap::State>> lookup(const Device& device, const encoding::EncodedView& set,
                                            std::span<const uint32_t> maps, std::span<const float> u,
                                            std::span<const float> v) {
    assert(u.size() == maps.size() && v.size() == maps.size());
    if (auto checked = checkSet(set); !checked) return checked.error();
    Lookups lookups{decoderOf(set.encoding), widthShiftOf(set.format), set.descriptors, set.payload, {}};
    for (size_t k = 0; k < maps.size(); ++k) {
        assert(maps[k] < set.mapCount);
        lookups.queries.push_back({maps[k], u[k], v[k]});
    }
    return statesOf<micromap::State>(device.data(), lookups);
}

Result<std::vector<quadmap::Region>> lookup(const Device& device, const quadmap::SquareReader& squares,
                                            std::span<const uint32_t> maps,
                                            std::span<const quadmap::Half> halves, std::span<const float> u,
                                            std::span<const float> v) {
    assert(halves.size() == maps.size() && u.size() == maps.size() && v.size() == maps.size());
    const auto decoder = decoderOf(squares.format());
    if (!decoder) return decoder.error();
    Lookups lookups{*decoder, 0, {}, squares.bytes(), {}};
    for (size_t k = 0; k < maps.size(); ++k) {
        assert(maps[k] < squares.mapCount());
        const uint32_t second = halves[k] == quadmap::Half::second ? 1 : 0;
        lookups.queries.push_back({2 * maps[k] + second, u[k], v[k]});
    }
    return statesOf<quadmap::Region>(device.data(), lookups);
}

}  // namespace filigree::vulkan
