#include "jobs/lookup_method.h"

#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/dag.h"
#include "filigree/encoding/flat.h"
#include "filigree/encoding/gruen.h"
#include "filigree/encoding/indexed_tree.h"
#include "filigree/encoding/sdag.h"
#include "filigree/encoding/tree.h"

#include "jobs/stopwatch.h"

#include <algorithm>
#include <utility>

namespace filigree::jobs {
namespace {

using encoding::EncodedSet;
using encoding::Encoding;
using micromap::Format;
using micromap::State;

constexpr size_t block = 1024;

// What a reader is asked for: a map or texture and a point in it.
struct Points {
    std::span<const uint32_t> sets;
    std::span<const float> x, y;
};

// The readers' own functions, without virtual calls, as a renderer would use them.
template <class Reader>
void lookUpInTurn(const Reader& reader, const Points& p, std::span<State> states) {
    for (size_t k = 0; k < states.size(); ++k) states[k] = reader.at(p.sets[k], p.x[k], p.y[k]);
}

template <class Reader>
void lookUpDependently(const Reader& reader, const Points& p, std::span<State> states) {
    size_t at = 0;
    for (size_t k = 0; k < states.size(); ++k) {
        const State state = reader.at(p.sets[at], p.x[at], p.y[at]);
        states[k] = state;
        at = std::min(nextPoint(k, state), p.sets.size() - 1);
    }
}

template <class Reader>
void lookUpInBlocks(const Reader& reader, const Points& p, std::span<State> states) {
    for (size_t first = 0; first < states.size(); first += block) {
        const size_t count = std::min(block, states.size() - first);
        reader.lookup(p.sets.subspan(first, count), p.x.subspan(first, count), p.y.subspan(first, count),
                      states.subspan(first, count));
    }
}

template <class Reader>
double timed(const Reader& reader, LookupMode mode, const Points& points, std::span<State> states) {
    const ThreadStopwatch watch;
    switch (mode) {
        case LookupMode::dependent:
            lookUpDependently(reader, points, states.first(lookupsOf(mode, states.size())));
            break;
        case LookupMode::independent:
            lookUpInTurn(reader, points, states);
            break;
        case LookupMode::batch:
            lookUpInBlocks(reader, points, states);
            break;
    }
    return watch.seconds();
}

// 1-bit gruen masks come from the 4-state bake, bitmasks know textures.
Points pointsFor(const EncodedSet& set, const LookupQueries& queries) {
    if (set.encoding == Encoding::bitmask) return {queries.textures, queries.s, queries.t};
    const bool cautious = set.encoding == Encoding::gruen && set.format == Format::twoState;
    return {cautious ? queries.cautiousMaps : queries.maps, queries.u, queries.v};
}

bool gruenAgrees(Format format, State exact, State found) {
    if (found == State::transparent) return exact == State::transparent;
    if (format == Format::twoState) return found == State::unknownOpaque;
    return found == (isKnown(exact) ? exact : State::unknownOpaque);
}

// Both hold near the point where both know. The side of a cell's centre says nothing of the point.
bool bitmaskAgrees(Format format, State exact, State found) {
    return format == Format::twoState || !isKnown(exact) || !isKnown(found) || exact == found;
}

template <class Reader>
class MethodOf final : public LookupMethod {
  public:
    MethodOf(EncodedSet set, Reader reader, const LookupQueries& queries)
        : set_(std::move(set)),
          reader_(std::move(reader)),
          queries_(queries),
          points_(pointsFor(set_, queries)) {}

    [[nodiscard]] Encoding encoding() const override { return set_.encoding; }
    double run(LookupMode mode, std::span<State> states) const override {
        return timed(reader_, mode, points_, states);
    }
    [[nodiscard]] bool agrees(size_t query, State exact, State found) const override {
        if (set_.encoding == Encoding::gruen) return gruenAgrees(set_.format, exact, found);
        if (set_.encoding == Encoding::bitmask)
            return queries_.vertexAlpha[query] || bitmaskAgrees(set_.format, exact, found);
        return exact == found;
    }

  private:
    EncodedSet set_;
    Reader reader_;  // looks into the blocks of set_
    const LookupQueries& queries_;
    Points points_;
};

template <class Reader>
Result<std::unique_ptr<LookupMethod>> open(EncodedSet set, const LookupQueries& queries) {
    auto reader = Reader::open(viewOf(set));
    if (!reader) return reader.error();
    return std::unique_ptr<LookupMethod>(
        std::make_unique<MethodOf<Reader>>(std::move(set), std::move(*reader), queries));
}

}  // namespace

Result<std::unique_ptr<LookupMethod>> lookupMethod(EncodedSet set, const LookupQueries& queries) {
    switch (set.encoding) {
        case Encoding::flat:
            return open<encoding::FlatReader>(std::move(set), queries);
        case Encoding::gruen:
            return open<encoding::GruenReader>(std::move(set), queries);
        case Encoding::bitmask:
            return open<encoding::BitmaskReader>(std::move(set), queries);
        case Encoding::tree:
            return open<encoding::TreeReader>(std::move(set), queries);
        case Encoding::indexedTree:
            return open<encoding::IndexedTreeReader>(std::move(set), queries);
        case Encoding::dag:
            return open<encoding::DagReader>(std::move(set), queries);
        case Encoding::sdag:
            return open<encoding::SdagReader>(std::move(set), queries);
    }
    return Error{ErrorKind::unsupported, "no lookups in this encoding"};
}

}  // namespace filigree::jobs
