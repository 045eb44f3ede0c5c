// Turns a reader of one encoding into a MapReader.
#pragma once

#include "filigree/encoding/map_reader.h"
#include "filigree/micromap/curve.h"
#include "filigree/micromap/curve_batch.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace filigree::encoding {

// Looks points up through curve indices, some at a time.
template <class Reader>
void lookupByCurve(const Reader& reader, std::span<const uint32_t> maps, std::span<const float> u,
                   std::span<const float> v, std::span<micromap::State> states) {
    assert(u.size() == maps.size() && v.size() == maps.size() && states.size() == maps.size());
    std::array<uint32_t, 256> levels;
    std::array<uint32_t, 256> indices;
    for (size_t first = 0; first < maps.size(); first += levels.size()) {
        const size_t count = std::min(levels.size(), maps.size() - first);
        for (size_t k = 0; k < count; ++k) levels[k] = reader.level(maps[first + k]);
        const auto some = std::span(indices).first(count);
        micromap::barycentricsToIndex(u.subspan(first, count), v.subspan(first, count),
                                      std::span(levels).first(count), some);
        reader.lookup(maps.subspan(first, count), some, states.subspan(first, count));
    }
}

// MapReader::opaqueShare by counting.
template <class Reader>
float countedShare(const Reader& reader, uint32_t map, uint32_t index, unsigned level) {
    assert(level <= reader.level(map) && index < micromap::microTriangleCount(level));
    const uint64_t count = micromap::microTriangleCount(reader.level(map) - level);
    const uint64_t first = index * count;
    uint64_t opaque = 0;
    for (uint64_t k = first; k < first + count; ++k) {
        opaque += micromap::isOpaqueSide(reader.at(map, static_cast<uint32_t>(k))) ? 1 : 0;
    }
    return static_cast<float>(static_cast<double>(opaque) / static_cast<double>(count));
}

// `Reader` has mapCount(), level(map), at(map, index), at(map, u, v), both lookup(...), bitsRead(map, index),
// decode(map) and parts() as MapReader has them, and opaqueShare(map, index, level) where it knows better
// than to count.
template <class Reader>
class ReaderOf final : public MapReader {
  public:
    explicit ReaderOf(Reader reader) : reader_(std::move(reader)) {}

    [[nodiscard]] uint32_t mapCount() const override { return reader_.mapCount(); }
    [[nodiscard]] unsigned level(uint32_t map) const override { return reader_.level(map); }
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const override {
        return reader_.at(map, index);
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const override {
        return reader_.at(map, u, v);
    }
    void lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                std::span<micromap::State> states) const override {
        reader_.lookup(maps, indices, states);
    }
    void lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                std::span<micromap::State> states) const override {
        reader_.lookup(maps, u, v, states);
    }
    [[nodiscard]] float opaqueShare(uint32_t map, uint32_t index, unsigned level) const override {
        if constexpr (requires { reader_.opaqueShare(map, index, level); }) {
            return reader_.opaqueShare(map, index, level);
        } else {
            return countedShare(reader_, map, index, level);
        }
    }
    [[nodiscard]] uint64_t bitsRead(uint32_t map, uint32_t index) const override {
        return reader_.bitsRead(map, index);
    }
    [[nodiscard]] micromap::Quadtree decode(uint32_t map) const override { return reader_.decode(map); }
    [[nodiscard]] std::vector<Part> parts() const override { return reader_.parts(); }

  private:
    Reader reader_;
};

// Opens a Reader, which has a static open(view) that checks everything, as a MapReader.
template <class Reader>
Result<std::unique_ptr<MapReader>> openAs(const EncodedView& set) {
    auto reader = Reader::open(set);
    if (!reader) return reader.error();
    return std::unique_ptr<MapReader>(std::make_unique<ReaderOf<Reader>>(std::move(*reader)));
}

}  // namespace filigree::encoding
