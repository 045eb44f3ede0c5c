#include "capi/squares.h"

#include "filigree/quadmap/pairs.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/context.h"
#include "capi/fill.h"
#include "capi/image.h"
#include "capi/parts.h"
#include "capi/primitives.h"
#include "capi/progress.h"
#include "capi/sized.h"
#include "capi/triangles.h"

#include <algorithm>
#include <vector>

namespace filigree::capi {
namespace {

using quadmap::SquareFormat;
using quadmap::SquarePlace;

// What edges are found by: positions, or where there are none texture coordinates.
std::vector<mesh::TrianglePair> pairsOf(const Triangles& triangles) {
    std::vector<std::array<float, 3>> positions(triangles.vertexCount());
    std::vector<uint32_t> indices;
    std::vector<mesh::Uv> uvs(triangles.vertexCount());
    for (size_t t = 0; t < triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const size_t vertex = triangles.vertex(t, k);
            const mesh::Uv uv = triangles.uv(t, k);
            uvs[vertex] = uv;
            positions[vertex] =
                triangles.hasPositions() ? triangles.position(vertex) : std::array<float, 3>{uv.u, uv.v, 0};
            indices.push_back(static_cast<uint32_t>(vertex));
        }
    }
    return mesh::pairTriangles({positions, uvs, indices});
}

filigree_squares_info infoOf(const filigree_squares& squares) {
    const SquareFormat format = squares.reader->format();
    filigree_squares_info info{};
    info.triangle_count = squares.indices.size();
    info.format = static_cast<uint32_t>(format);
    info.side = sideOf(format);
    info.block_count = static_cast<uint32_t>(squares.reader->mapCount());
    info.block_bytes = static_cast<uint32_t>(blockBytesOf(format));
    return info;
}

uint8_t codeOf(SquarePlace place) {
    return static_cast<uint8_t>(static_cast<unsigned>(place.half) | static_cast<unsigned>(place.order) << 1);
}

quadmap::Region regionOfTriangle(const filigree_squares& squares, size_t triangle, float u, float v) {
    const int32_t index = squares.indices[triangle];
    if (index == -1) return quadmap::Region::transparent;
    if (index == -2) return quadmap::Region::opaque;
    if (index < 0) return quadmap::Region::mixed;
    const quadmap::Cell cell =
        quadmap::regionOf(squares.places[triangle], u, v, sideOf(squares.reader->format()));
    return squares.reader->at(static_cast<size_t>(index), cell.x, cell.y);
}

void checkBlocks(std::span<const uint32_t> blocks, std::span<const uint8_t> halves, size_t blockCount) {
    for (size_t k = 0; k < blocks.size(); ++k) {
        if (blocks[k] >= blockCount)
            fail(FILIGREE_ERROR_ARGUMENT, "blocks: element {} is {}, expected less than {}", k, blocks[k],
                 blockCount);
        if (halves[k] > 1)
            fail(FILIGREE_ERROR_ARGUMENT, "halves: element {} is {}, expected 0 or 1", k, halves[k]);
    }
}

}  // namespace

Owned<filigree_squares> squaresOf(const Memory& memory, SquareFormat format, std::span<const uint8_t> blocks,
                                  Array<int32_t> indices, Array<SquarePlace> places) {
    auto squares = makeHandle<filigree_squares>(memory);
    squares->blocks = Array<uint8_t>(memory, blocks);
    squares->indices = std::move(indices);
    squares->places = std::move(places);
    squares->reader = orFail(quadmap::SquareReader::open(format, squares->blocks.values()));
    return squares;
}

}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_squares_encode(const filigree_context* context, const filigree_triangles* triangles,
                                       const filigree_image* image, const filigree_alpha_test* test,
                                       uint32_t format, const filigree_progress* progress,
                                       filigree_squares** out, filigree_error_info* error) {
    return make(out, error, [&] {
        CallerProgress told(progress);
        const Triangles given(triangles);
        const auto texture = textureOf(image);
        const auto alphaTest = testOf(test);
        const auto wanted = enumerator(format, SquareFormat::vq4Plus, "format");
        const auto set = orFail(filigree::quadmap::encodeSquares(
            given.all(), pairsOf(given), texture, alphaTest, wanted, executorOf(context), told.sink()));
        const Memory memory = memoryOf(context);
        auto squares = squaresOf(memory, set.format, set.blocks, {memory, set.indices}, {memory, set.places});
        squares->primitives = onePrimitive(memory, given.size());
        return squares.release();
    });
}

void filigree_squares_destroy(filigree_squares* squares) {
    destroy(squares);
}

filigree_error filigree_squares_get_info(const filigree_squares* squares, filigree_squares_info* info,
                                         filigree_error_info* error) {
    return call(error, [&] { give(infoOf(required(squares, "squares")), info, "info"); });
}

filigree_error filigree_squares_get_blocks(const filigree_squares* squares, uint8_t* to, size_t capacity,
                                           size_t* count, filigree_error_info* error) {
    return call(error, [&] { fillFrom(required(squares, "squares").blocks.values(), to, capacity, count); });
}

filigree_error filigree_squares_get_indices(const filigree_squares* squares, int32_t* to, size_t capacity,
                                            size_t* count, filigree_error_info* error) {
    return call(error, [&] { fillFrom(required(squares, "squares").indices.values(), to, capacity, count); });
}

filigree_error filigree_squares_get_places(const filigree_squares* squares, uint8_t* to, size_t capacity,
                                           size_t* count, filigree_error_info* error) {
    return call(error, [&] {
        const auto places = required(squares, "squares").places.values();
        fill(to, capacity, count, places.size(),
             [&](std::span<uint8_t> room) { std::ranges::transform(places, room.begin(), codeOf); });
    });
}

int filigree_squares_triangle_region(const filigree_squares* squares, size_t triangle, float u, float v) {
    if (squares == nullptr || triangle >= squares->indices.size()) return -1;
    return static_cast<int>(regionOfTriangle(*squares, triangle, u, v));
}

filigree_error filigree_squares_lookup(const filigree_squares* squares, size_t count, const uint32_t* blocks,
                                       const uint8_t* halves, const float* u, const float* v,
                                       uint8_t* regions, filigree_error_info* error) {
    using filigree::quadmap::Half;
    using filigree::quadmap::Region;
    return call(error, [&] {
        const auto& reader = *required(squares, "squares").reader;
        const auto blockList = listOf(blocks, count, "blocks");
        const auto halfList = listOf(halves, count, "halves");
        const auto uList = listOf(u, count, "u");
        const auto vList = listOf(v, count, "v");
        const auto to = listOf(reinterpret_cast<Region*>(regions), count, "regions");
        checkApart(to, blockList, "regions", "blocks");
        checkApart(to, halfList, "regions", "halves");
        checkApart(to, uList, "regions", "u");
        checkApart(to, vList, "regions", "v");
        inParts(count, [&](size_t first, size_t some) {
            const auto part = [&](auto list) { return list.subspan(first, some); };
            checkBlocks(part(blockList), part(halfList), reader.mapCount());
            const std::span places(reinterpret_cast<const Half*>(halves) + first, some);
            reader.lookup(part(blockList), places, part(uList), part(vList), part(to));
        });
    });
}
