#include "filigree/quadmap/pairs.h"

#include "filigree/quadmap/encode.h"

#include <bit>

#include <fmt/format.h>

namespace filigree::quadmap {
namespace {

// Bit patterns, so that NaN equals itself and 0 differs from -0. The last says whether there is a second.
std::array<uint32_t, 19> kindOf(const SquarePair& pair) {
    std::array<uint32_t, 19> kind{};
    size_t next = 0;
    const auto add = [&](const HalfTriangle& half) {
        for (size_t k = 0; k < 3; ++k) {
            for (const float value : {half.uv[k].u, half.uv[k].v, half.alpha[k]})
                kind[next++] = std::bit_cast<uint32_t>(value);
        }
    };
    add(pair.first);
    if (pair.second) add(*pair.second);
    kind.back() = pair.second ? 1 : 0;
    return kind;
}

bool isIn(Half half, const Square& square, unsigned x, unsigned y) {
    return half == Half::first ? x + y < square.side : x + y + 1 >= square.side;
}

// The special index of a half that is one state throughout, else needsBlock.
int32_t specialOf(const Square& square, Half half) {
    const unsigned last = square.side - 1;
    const Region first = half == Half::first ? square.at(0, 0) : square.at(last, last);
    for (unsigned y = 0; y < square.side; ++y) {
        for (unsigned x = 0; x < square.side; ++x) {
            if (isIn(half, square, x, y) && square.at(x, y) != first) return EncodedPair::needsBlock;
        }
    }
    return first == Region::transparent ? -1 : first == Region::opaque ? -2 : -4;
}

template <class Block>
std::vector<uint8_t> bytesOf(const Block& block) {
    return {block.begin(), block.end()};
}

std::vector<uint8_t> blockOf(const Square& square, SquareFormat format) {
    switch (format) {
        case SquareFormat::vq2:
            return bytesOf(encodeVq2(square, Vq2Method::best));
        case SquareFormat::vq2Plus:
            return bytesOf(encodeVq2Plus(square));
        case SquareFormat::vq4:
            return bytesOf(encodeVq4(square, Vq4Method::fast));
        default:
            return bytesOf(encodeVq4Plus(square, Vq4Method::fast));
    }
}

std::vector<EncodedPair> encodeAll(const SquareMaker& maker, const std::vector<SquarePair>& pairs,
                                   SquareFormat format, const Executor& executor, ProgressSink& progress) {
    std::vector<EncodedPair> encoded(pairs.size());
    progress.begin("encode", pairs.size(), "maps");
    executor.parallelFor(pairs.size(), 4, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end && !progress.cancelled(); ++k) {
            encoded[k] = encodePair(maker, pairs[k], format);
            progress.advance(1);
        }
    });
    progress.end();
    return encoded;
}

}  // namespace

uint32_t DistinctPairs::add(const SquarePair& pair) {
    const auto next = static_cast<uint32_t>(pairs_.size());
    const auto [place, isNew] = numbers_.try_emplace(kindOf(pair), next);
    if (isNew) pairs_.push_back(pair);
    return place->second;
}

EncodedPair encodePair(const SquareMaker& maker, const SquarePair& pair, SquareFormat format) {
    const unsigned side = sideOf(format);
    const Square square =
        pair.second ? maker.ofPair(pair.first, *pair.second, side) : maker.ofSingle(pair.first, side);
    EncodedPair encoded;
    encoded.special[0] = specialOf(square, Half::first);
    encoded.special[1] = pair.second ? specialOf(square, Half::second) : -4;
    const bool isNeeded =
        encoded.special[0] == EncodedPair::needsBlock || encoded.special[1] == EncodedPair::needsBlock;
    if (isNeeded) encoded.block = blockOf(square, format);
    return encoded;
}

void BlockList::add(const mesh::TrianglePair& pair, const EncodedPair& encoded, std::span<int32_t> indices,
                    std::span<SquarePlace> places) {
    const auto stand = [&](const mesh::PairedTriangle& triangle, Half half) {
        const int32_t special = encoded.special[static_cast<size_t>(half)];
        indices[triangle.triangle] = special;
        if (special != EncodedPair::needsBlock) return;
        indices[triangle.triangle] = numberOf(encoded.block);
        places[triangle.triangle] = {half, orderOf(triangle.order)};
    };
    stand(pair.first, Half::first);
    if (pair.second) stand(*pair.second, Half::second);
}

int32_t BlockList::numberOf(const std::vector<uint8_t>& block) {
    const auto [found, isNew] = numbers_.try_emplace(block, static_cast<int32_t>(numbers_.size()));
    if (isNew) blocks_.insert(blocks_.end(), block.begin(), block.end());
    return found->second;
}

Result<SquareSet> encodeSquares(std::span<const mesh::UvTriangle> triangles,
                                std::span<const mesh::TrianglePair> pairs, const image::AlphaTexture& texture,
                                const image::AlphaTest& test, SquareFormat format, const Executor& executor,
                                ProgressSink& progress) {
    if (format == SquareFormat::raw16 || format == SquareFormat::raw32)
        return Error{ErrorKind::usage, fmt::format("format {}: has no encoder", nameOf(format))};
    DistinctPairs distinct;
    std::vector<uint32_t> kinds;
    for (const mesh::TrianglePair& pair : pairs) {
        SquarePair square{inSquare(triangles[pair.first.triangle], pair.first), {}};
        if (pair.second) square.second = inSquare(triangles[pair.second->triangle], *pair.second);
        kinds.push_back(distinct.add(square));
    }
    const SquareMaker maker(texture, test);
    const auto encoded = encodeAll(maker, distinct.pairs(), format, executor, progress);
    if (progress.cancelled()) return Error{ErrorKind::cancelled, "the encoding of squares was cancelled"};
    SquareSet set;
    set.format = format;
    set.indices.resize(triangles.size(), -4);
    set.places.resize(triangles.size());
    BlockList blocks;
    for (size_t k = 0; k < pairs.size(); ++k)
        blocks.add(pairs[k], encoded[kinds[k]], set.indices, set.places);
    set.blocks = std::move(blocks).take();
    return set;
}

}  // namespace filigree::quadmap
