// Codec `lattice`: tiles of up to 16 x 16 quads, decoded block by block. docs/spec/lattice.md; the plain decoder is
// src/grid/tile_decode.cpp.
#ifndef FILIGREE_DECODE_LATTICE
#define FILIGREE_DECODE_LATTICE
#include "records.glsl"

// Patches by the steps along an axis: which of five places hold a vertex, and the places in order, three bits each.
const uint latticePlaceMask[5] = uint[](0u, 17u, 21u, 29u, 31u);
const uint latticePlaces[5] = uint[](0u, 040u, 0420u, 04320u, 043210u);

bool isPlace(uint steps, uint place) {
    return ((latticePlaceMask[steps] >> place) & 1u) != 0u;
}
uint placeOfVertex(uint steps, uint vertex) {
    return (latticePlaces[steps] >> (3u * vertex)) & 7u;
}
uint vertexAtPlace(uint steps, uint place) {
    return uint(bitCount(lowestBits(latticePlaceMask[steps], place)));
}

// Classes of residuals.
const uint edgeMid = 0u;
const uint edgeQuarter = 1u;
const uint insideCentre = 2u;
const uint insideCross = 3u;
const uint insideDiagonal = 4u;
const uint evenBias = 4u;

// Vertices of a class on an edge of so many steps.
uint onEdge(uint class_, uint steps) {
    if (steps < 2u) return 0u;
    return class_ == edgeMid ? 1u : steps - 2u;
}

// The places of a patch but its corners and its centre, 5 y + x: edge mids, then edge quarters and crosses, then
// diagonals, in the order of a block's fields.
const uint latticeMids[4] = uint[](2u, 22u, 10u, 14u);
const uint latticeQuarters[12] = uint[](1u, 3u, 21u, 23u, 5u, 15u, 9u, 19u, 7u, 11u, 13u, 17u);
const uint latticeDiagonals[4] = uint[](6u, 8u, 16u, 18u);
const uint latticeCentre = 12u;

// A tile's header, and where its parts begin.
struct LatticeTile {
    uint record;  // word
    uvec2 quads;
    uvec2 blocks;
    uint dominant;
    int curve;
    uvec3 widths;  // words 5 to 7 of the header
    uint others;   // word 8
    ivec3 slope;   // 256ths of the dominant residual, by axis, and how it grows
    ivec3 slopePerColumn;
    ivec3 slopePerRow;
    uint diagonals;  // 0 all ac, 1 all bd, 2 mixed
    // In bits from the record's first.
    uint bits;
    uint coarse;
    uint edgeMids;
    uint edgeQuarters;
    uint insides;
};

uvec3 coarseWidths(LatticeTile tile) {
    return (tile.widths >> 5u) & 31u;
}
uvec3 classWidths(LatticeTile tile, uint class_) {
    return (class_ == insideDiagonal ? uvec3(tile.others) >> uvec3(0u, 5u, 10u) : tile.widths >> (10u + 5u * class_)) & 31u;
}
// Inside blocks, less their drop.
uvec3 insideWidths(LatticeTile tile, uint class_, uint drop) {
    const uvec3 width = classWidths(tile, class_);
    return width - min(width, uvec3(drop));
}
uint sumOf(uvec3 v) {
    return v.x + v.y + v.z;
}

uint stepsOf(uint quads, uint block) {
    return min(4u, quads - 4u * block);
}
// Vertices of a class on all horizontal edges of one line between blocks, or on all vertical ones of a column of lines.
uint onLine(uint class_, uint quads, uint blocks) {
    return (blocks - 1u) * onEdge(class_, 4u) + onEdge(class_, stepsOf(quads, blocks - 1u));
}
uint onEdges(LatticeTile tile, uint class_) {
    return onLine(class_, tile.quads.x, tile.blocks.x) * (tile.blocks.y + 1u) +
           onLine(class_, tile.quads.y, tile.blocks.y) * (tile.blocks.x + 1u);
}

LatticeTile latticeTile(uint record) {
    LatticeTile tile;
    tile.record = record;
    const uint first = recordWord(record, 0u);
    const uint second = recordWord(record, 1u);
    tile.quads = uvec2((first >> 24) & 15u, first >> 28) + 1u;
    tile.blocks = (tile.quads + 3u) >> 2;
    tile.diagonals = (second >> 24) & 3u;
    tile.dominant = (second >> 26) & 3u;
    tile.curve = int(second >> 28);
    tile.widths = uvec3(recordWord(record, 5u), recordWord(record, 6u), recordWord(record, 7u));
    tile.others = recordWord(record, 8u);
    const uint shear = recordWord(record, 9u);
    tile.slope = 8 * besides(tile.dominant, signedBits(shear, 0, 6), signedBits(shear, 16, 6));
    tile.slopePerColumn = besides(tile.dominant, signedBits(shear, 6, 5), signedBits(shear, 22, 5));
    tile.slopePerRow = besides(tile.dominant, signedBits(shear, 11, 5), signedBits(shear, 27, 5));
    const uint blocks = tile.blocks.x * tile.blocks.y;
    tile.bits = 8u * (40u + (tile.diagonals == 2u ? 3u : 1u) * blocks);
    tile.coarse = tile.bits + 3u * sumOf(tile.widths & 31u);
    const uint coarseVertices = (tile.blocks.x + 1u) * (tile.blocks.y + 1u) - 4u;
    tile.edgeMids = tile.coarse + coarseVertices * sumOf(coarseWidths(tile));
    tile.edgeQuarters = tile.edgeMids + onEdges(tile, edgeMid) * sumOf(classWidths(tile, edgeMid));
    tile.insides = tile.edgeQuarters + onEdges(tile, edgeQuarter) * sumOf(classWidths(tile, edgeQuarter));
    return tile;
}

// A block's byte: drop, low and high.
uint blockByte(LatticeTile tile, uvec2 block) {
    return recordBits(tile.record, 8u * (40u + block.y * tile.blocks.x + block.x), 8u);
}
uint dropOf(uint blockByte_) {
    const uint drop = blockByte_ & 3u;
    return drop == 3u ? 24u : drop;
}
// Which of a block's quads have the diagonal bd: bit 4 row + column.
uint blockDiagonals(LatticeTile tile, uvec2 block) {
    if (tile.diagonals != 2u) return tile.diagonals == 1u ? 0xffffu : 0u;
    const uint number = block.y * tile.blocks.x + block.x;
    return recordBits(tile.record, 8u * (40u + tile.blocks.x * tile.blocks.y) + 16u * number, 16u);
}

// Bits of what lies inside a block.
uint insideBits(LatticeTile tile, uvec2 block) {
    const uvec2 steps = uvec2(stepsOf(tile.quads.x, block.x), stepsOf(tile.quads.y, block.y));
    const uvec2 mids = uvec2(onEdge(edgeMid, steps.x), onEdge(edgeMid, steps.y));
    const uvec2 quarters = uvec2(onEdge(edgeQuarter, steps.x), onEdge(edgeQuarter, steps.y));
    const uint drop = dropOf(blockByte(tile, block));
    return mids.x * mids.y * sumOf(insideWidths(tile, insideCentre, drop)) +
           (mids.x * quarters.y + quarters.x * mids.y) * sumOf(insideWidths(tile, insideCross, drop)) +
           quarters.x * quarters.y * sumOf(insideWidths(tile, insideDiagonal, drop));
}
// Where they begin.
uint insideAt(LatticeTile tile, uvec2 block) {
    uint at = tile.insides;
    for (uint k = 0u; k < block.y * tile.blocks.x + block.x; ++k)
        at += insideBits(tile, uvec2(k % tile.blocks.x, k / tile.blocks.x));
    return at;
}

// The residual of the vertex at a place of the frame, from its fields at a bit.
ivec3 latticeResidual(LatticeTile tile, uint bit, uvec3 width, uint dominantBias, uvec2 place) {
    const uvec3 isDominant = uvec3(equal(uvec3(tile.dominant), uvec3(0u, 1u, 2u)));
    const uvec3 bias = uvec3(evenBias) * (1u - isDominant) + dominantBias * isDominant;
    const ivec3 even = recordFields(tile.record, bit, width) - ivec3((bias << width) >> 3u);
    const ivec2 from = ivec2(place) - 8;
    const ivec3 slope = tile.slope + tile.slopePerColumn * from.x + tile.slopePerRow * from.y;
    return even + ((slope * onAxis(even, tile.dominant) + 128) >> 8);
}

// The patch that is being decoded, at 5 y + x, and the corners of all blocks, a patch, too.
ivec3 latticePatch[25];
ivec3 latticeCoarse[25];

ivec3 halfWay(ivec3 p, ivec3 q) {
    return (p + q + 1) >> 1;
}
ivec3 midOf(ivec3 p, ivec3 q, uint steps) {
    return steps == 3u ? p + ((85 * (q - p) + 128) >> 8) : halfWay(p, q);
}
ivec3 midPrediction(uint at, uvec2 steps) {
    if (at == 2u || at == 22u) return midOf(latticePatch[at - 2u], latticePatch[at + 2u], steps.x);
    return midOf(latticePatch[at - 10u], latticePatch[at + 10u], steps.y);
}
ivec3 centrePrediction(uvec2 steps) {
    const ivec3 top = midOf(latticePatch[0], latticePatch[4], steps.x);
    const ivec3 bottom = midOf(latticePatch[20], latticePatch[24], steps.x);
    return midOf(latticePatch[10], latticePatch[14], steps.x) + midOf(latticePatch[2], latticePatch[22], steps.y) -
           midOf(top, bottom, steps.y);
}
// Between the places 2 and 0 or 4 of a line, down where x is even.
ivec3 quarterPrediction(uint at, uvec2 steps, int curve) {
    const uvec2 place = uvec2(at % 5u, at / 5u);
    const bool across = (place.x & 1u) != 0u;
    const uint one = across ? 1u : 5u;
    const uint along = across ? place.x : place.y;
    const uint line = at - one * along;
    const ivec3 end = latticePatch[line + (along == 1u ? 0u : 4u * one)];
    const ivec3 two = latticePatch[line + 2u * one];
    const ivec3 other = latticePatch[line + (along == 1u ? 4u * one : 0u)];
    const int bend = (across ? steps.x : steps.y) == 4u ? curve : 0;
    return halfWay(end, two) + ((bend * (2 * two - end - other) + 16) >> 5);
}
ivec3 diagonalPrediction(uint at) {
    const ivec3 beside = latticePatch[at - 1u] + latticePatch[at + 1u] + latticePatch[at - 5u] + latticePatch[at + 5u];
    const ivec3 around = latticePatch[at - 6u] + latticePatch[at - 4u] + latticePatch[at + 4u] + latticePatch[at + 6u];
    return (2 * beside - around + 2) >> 2;
}

void decodeCorners(LatticeTile tile) {
    const uvec3 width = tile.widths & 31u;
    const uint one = sumOf(width);
    const ivec3 even = ivec3((uvec3(evenBias) << width) >> 3u);
    const ivec3 base = ivec3(recordWord(tile.record, 2u), recordWord(tile.record, 3u), recordWord(tile.record, 4u)) & latticeMask;
    const ivec3 right = (base + recordFields(tile.record, tile.bits, width) - even) & latticeMask;
    const ivec3 below = (base + recordFields(tile.record, tile.bits + one, width) - even) & latticeMask;
    const ivec3 across = right + below - base;
    latticePatch[0] = base;
    latticePatch[4] = right;
    latticePatch[20] = below;
    latticePatch[24] = (across + recordFields(tile.record, tile.bits + 2u * one, width) - even) & latticeMask;
}

// Where a coarse vertex stands among those that are not the tile's corners, row by row.
uint coarseNumber(uvec2 blocks, uvec2 place) {
    const uint column = vertexAtPlace(blocks.x, place.x);
    const uint row = vertexAtPlace(blocks.y, place.y);
    const uint corners = row == 0u ? 1u : row < blocks.y ? 2u : 3u;
    return row * (blocks.x + 1u) + column - corners;
}

// Where a vertex of a class on an edge of a block stands among all of the class.
uint edgeNumber(LatticeTile tile, uint class_, uvec2 block, uvec2 place, uvec2 steps) {
    const uint inBlock = onEdge(class_, 4u);
    const uint acrossLine = onLine(class_, tile.quads.x, tile.blocks.x);
    const bool across = (place.y & 3u) == 0u;
    const uint along = across ? place.x : place.y;
    const uint second = class_ == edgeQuarter && along == 3u && (across ? steps.x : steps.y) == 4u ? 1u : 0u;
    if (across) return (block.y + (place.y >> 2)) * acrossLine + block.x * inBlock + second;
    return acrossLine * (tile.blocks.y + 1u) + block.y * (tile.blocks.x + 1u) * inBlock +
           (block.x + (place.x >> 2)) * onEdge(class_, steps.y) + second;
}

// What latticePatch is to hold: the corners of all blocks, or the vertices of one.
struct LatticeWork {
    bool isCoarse;
    uvec2 block;
    uvec2 steps;
    int curve;
    uint drop;
    uint inside;  // bit of the next vertex inside the block
};

// Sets a vertex that is not vacant.
void addVertex(LatticeTile tile, inout LatticeWork work, uint class_, uint at, ivec3 prediction) {
    const uvec2 place = uvec2(at % 5u, at / 5u);
    if (!isPlace(work.steps.x, place.x) || !isPlace(work.steps.y, place.y)) return;
    ivec3 residual;
    if (work.isCoarse) {
        const uvec3 width = coarseWidths(tile);
        const uint bit = tile.coarse + coarseNumber(work.steps, place) * sumOf(width);
        residual = latticeResidual(tile, bit, width, evenBias, 4u * place);
    } else {
        const bool isInside = class_ >= insideCentre;
        const uvec3 width = insideWidths(tile, class_, isInside ? work.drop : 0u);
        const uint bias = (tile.others >> (15u + 3u * class_)) & 7u;
        uint bit = work.inside;
        if (isInside) {
            work.inside += sumOf(width);
        } else {
            bit = (class_ == edgeMid ? tile.edgeMids : tile.edgeQuarters) +
                  edgeNumber(tile, class_, work.block, place, work.steps) * sumOf(width);
        }
        residual = latticeResidual(tile, bit, width, bias, 4u * work.block + place);
    }
    latticePatch[at] = (prediction + residual) & latticeMask;
}

// From its corners on.
void decodePatch(LatticeTile tile, LatticeWork work) {
    [[dont_unroll]] for (uint k = 0u; k < 4u; ++k) addVertex(tile, work, edgeMid, latticeMids[k], midPrediction(latticeMids[k], work.steps));
    addVertex(tile, work, insideCentre, latticeCentre, centrePrediction(work.steps));
    [[dont_unroll]] for (uint k = 0u; k < 12u; ++k) {
        const uint at = latticeQuarters[k];
        addVertex(tile, work, k < 8u ? edgeQuarter : insideCross, at, quarterPrediction(at, work.steps, work.curve));
    }
    [[dont_unroll]] for (uint k = 0u; k < 4u; ++k) {
        const uint at = latticeDiagonals[k];
        addVertex(tile, work, insideDiagonal, at, diagonalPrediction(at));
    }
}

// Fills latticeCoarse.
void decodeCoarse(LatticeTile tile) {
    decodeCorners(tile);
    decodePatch(tile, LatticeWork(true, uvec2(0u), tile.blocks, 0, 0u, 0u));
    latticeCoarse = latticePatch;
}
ivec3 blockCorner(LatticeTile tile, uint column, uint row) {
    return latticeCoarse[5u * placeOfVertex(tile.blocks.y, row) + placeOfVertex(tile.blocks.x, column)];
}

// Fills latticePatch from latticeCoarse; the block's inside begins at bit `inside`.
void decodeBlock(LatticeTile tile, uvec2 block, uint inside) {
    latticePatch[0] = blockCorner(tile, block.x, block.y);
    latticePatch[4] = blockCorner(tile, block.x + 1u, block.y);
    latticePatch[20] = blockCorner(tile, block.x, block.y + 1u);
    latticePatch[24] = blockCorner(tile, block.x + 1u, block.y + 1u);
    const uvec2 steps = uvec2(stepsOf(tile.quads.x, block.x), stepsOf(tile.quads.y, block.y));
    decodePatch(tile, LatticeWork(false, block, steps, tile.curve, dropOf(blockByte(tile, block)), inside));
}

// One vertex of a tile: random access takes the tile's coarse vertices and one block.
ivec3 latticeVertex(LatticeTile tile, uint column, uint row) {
    const uvec2 block = min(uvec2(column, row), tile.quads - 1u) >> 2;
    const uvec2 steps = uvec2(stepsOf(tile.quads.x, block.x), stepsOf(tile.quads.y, block.y));
    decodeCoarse(tile);
    decodeBlock(tile, block, insideAt(tile, block));
    const uint x = placeOfVertex(steps.x, column - 4u * block.x);
    const uint y = placeOfVertex(steps.y, row - 4u * block.y);
    return latticePatch[5u * y + x];
}
bool latticeDiagonal(LatticeTile tile, uint column, uint row) {
    const uint bit = 4u * (row & 3u) + (column & 3u);
    return ((blockDiagonals(tile, uvec2(column, row) >> 2) >> bit) & 1u) != 0u;
}

#endif
