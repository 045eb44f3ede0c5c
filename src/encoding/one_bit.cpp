#include "filigree/encoding/one_bit.h"

#include "encoding/sides.h"

#include <array>
#include <cassert>

#include <fmt/format.h>

namespace filigree::encoding {

using micromap::State;

namespace {

// What the bits 0 and 1 of a stored map mean, by StatePair.
constexpr std::array<std::array<State, 2>, statePairCount> statesOf{{
    {State::transparent, State::opaque},
    {State::transparent, State::unknownOpaque},
    {State::unknownTransparent, State::opaque},
}};

const std::array<State, 2>& of(StatePair pair) {
    return statesOf[static_cast<size_t>(pair)];
}

bool holds(StatePair pair, State state) {
    return of(pair)[0] == state || of(pair)[1] == state;
}

State unknownIn(StatePair pair) {
    return of(pair)[pair == StatePair::transparentUnknown ? 1 : 0];
}

}  // namespace

StatePair bestPair(const micromap::QuadtreeView& map) {
    const micromap::StateCounts counts = micromap::countStates(map);
    const auto count = [&](State state) { return counts.of[static_cast<size_t>(state)]; };
    const uint64_t transparent = count(State::transparent);
    const uint64_t opaque = count(State::opaque);
    if (counts.known() == counts.total()) return StatePair::transparentOpaque;
    if (transparent != opaque)
        return transparent > opaque ? StatePair::transparentUnknown : StatePair::unknownOpaque;
    return count(State::unknownOpaque) >= count(State::unknownTransparent) ? StatePair::transparentUnknown
                                                                           : StatePair::unknownOpaque;
}

micromap::Quadtree inPair(const micromap::QuadtreeView& map, StatePair pair) {
    return restated(map, [&](State state) {
        assert(pair != StatePair::transparentOpaque || micromap::isKnown(state));
        return holds(pair, state) ? state : unknownIn(pair);
    });
}

micromap::Quadtree fromPair(const micromap::QuadtreeView& sides, StatePair pair) {
    return restated(sides, [&](State state) { return of(pair)[micromap::isOpaqueSide(state) ? 1 : 0]; });
}

std::vector<uint8_t> packPairs(std::span<const StatePair> pairs) {
    std::vector<uint8_t> bytes((pairs.size() + 3) / 4, 0);
    for (size_t k = 0; k < pairs.size(); ++k) {
        const unsigned bits = static_cast<unsigned>(pairs[k]) << (2 * (k % 4));
        bytes[k / 4] = static_cast<uint8_t>(bytes[k / 4] | bits);
    }
    return bytes;
}

Result<PairReader> PairReader::open(const EncodedView& set, std::span<const uint8_t> bytes) {
    const auto refuse = [](std::string message) { return Error{ErrorKind::format, "pairs: " + message}; };
    if (set.format != micromap::Format::twoState || set.encoding == Encoding::bitmask)
        return refuse("only 2-state micromaps have some");
    const uint64_t wanted = (uint64_t{set.mapCount} + 3) / 4;
    if (bytes.size() != wanted)
        return refuse(fmt::format("{} bytes for {} maps, {} expected", bytes.size(), set.mapCount, wanted));
    const PairReader reader(bytes);
    for (uint32_t map = 0; map < set.mapCount; ++map) {
        if (static_cast<unsigned>(reader[map]) >= statePairCount)
            return refuse(fmt::format("map {} has code 3, which is reserved", map));
    }
    if (set.mapCount % 4 != 0 && bytes.back() >> (2 * (set.mapCount % 4)) != 0)
        return refuse("spare bits of the last byte are not zero");
    return reader;
}

}  // namespace filigree::encoding
