// Rays against the records of compressed grids, in lattice coordinates, as src/grid/block_test-inl.h has it: for ray
// queries and for intersection shaders. The grids are a part of the scene's words: GridWords of src/vulkan/grid_words.h.
#define GRID_WORDS SceneWords(scene).words
#include "decode/cluster.glsl"
#include "decode/lattice.glsl"

// Numbers of words from `grids` on.
vec3 gridVector(uint at) {
    return vec3(real(grids + at), real(grids + at + 1u), real(grids + at + 2u));
}

// A ray with its own third axis, x - shear.x z and y - shear.y z across it (Woop, Benthin and Wald 2013).
struct GridRay {
    vec3 origin;
    vec3 direction;
    uint axis;  // the longest of the direction
    vec2 shear;
    float scale;
    // Planes of boxes: (low - boxLow) * reciprocal and (high - boxHigh) * reciprocal.
    vec3 boxLow;
    vec3 boxHigh;
    vec3 reciprocal;
};

// The nearest hit of a ray on a grid.
struct GridHit {
    float t;
    uint record;   // its number
    uint place;    // bits 0-3 column, 4-7 row of the quad in its tile, 8 which half; of a cluster its triangle
    vec2 weights;  // of the triangle's vertices 1 and 2
    vec3 normal;   // world units, not of length 1
};

// Turns the axes so that `axis` comes third.
vec3 turned(vec3 v, uint axis) {
    return axis == 0u ? v.yzx : axis == 1u ? v.zxy : v;
}

const float boxSlack = 1.9073486328125e-6;  // bvh::walkSlack
const float steepest = 1.152921504606846976e18;

GridRay gridRay(vec3 origin, vec3 direction) {
    GridRay ray;
    const vec3 perStep = gridVector(9u);
    const precise vec3 from = ((origin - gridVector(0u)) - gridVector(3u)) * perStep;
    const precise vec3 along = direction * perStep;
    ray.origin = from;
    ray.direction = along;
    const vec3 length_ = abs(along);
    ray.axis = length_.y > length_.x ? (length_.z > length_.y ? 2u : 1u) : (length_.z > length_.x ? 2u : 0u);
    const vec3 own = turned(along, ray.axis);
    ray.shear = own.xy / own.z;
    ray.scale = 1.0 / own.z;
    const vec3 slack = boxSlack * (gridVector(12u) + abs(from));
    ray.boxLow = from + slack;
    ray.boxHigh = from - slack;
    ray.reciprocal = mix(1.0 / along, mix(vec3(steepest), vec3(-steepest), lessThan(along, vec3(0.0))),
                         lessThan(length_, vec3(1.0 / steepest)));
    return ray;
}

bool passesBox(GridRay ray, vec3 low, vec3 high, float tMin, float tMax) {
    const vec3 a = (low - ray.boxLow) * ray.reciprocal;
    const vec3 b = (high - ray.boxHigh) * ray.reciprocal;
    const vec3 near = min(a, b);
    const vec3 far = max(a, b);
    return max(max(near.x, near.y), max(near.z, tMin)) <= min(min(far.x, far.y), min(far.z, tMax));
}

// A vertex seen along the ray: x and y across it, z before it is scaled to t. The same for all triangles that share it.
vec3 seen(GridRay ray, ivec3 point) {
    const precise vec3 at = turned(vec3(point) - ray.origin, ray.axis);
    const precise vec2 across = at.xy - ray.shear * at.z;
    return vec3(across, at.z);
}

// Twice the area of the triangle that the ray makes with p and q; of (q, p) exactly the negative, so that of two
// triangles at an edge at least one takes the ray.
float edgeOf(vec3 p, vec3 q) {
    const precise float area = q.x * p.y - q.y * p.x;
    return area;
}

// What rounding took off a product (Dekker 1971).
float restOfProduct(float a, float b, float product) {
    const precise float a1 = 4097.0 * a;
    const precise float b1 = 4097.0 * b;
    const precise float aHigh = a1 - (a1 - a);
    const precise float bHigh = b1 - (b1 - b);
    const precise float aLow = a - aHigh;
    const precise float bLow = b - bHigh;
    const precise float rest = aLow * bLow - (((product - aHigh * bHigh) - aLow * bHigh) - aHigh * bLow);
    return rest;
}
// The same as edgeOf where that is zero, with its sign.
float exactEdgeOf(vec3 p, vec3 q) {
    const precise float first = q.x * p.y;
    const precise float second = q.y * p.x;
    const precise float area = (first - second) + (restOfProduct(q.x, p.y, first) - restOfProduct(q.y, p.x, second));
    return area;
}

bool haveOneSign(vec3 edges) {
    return all(greaterThanEqual(edges, vec3(0.0))) || all(lessThanEqual(edges, vec3(0.0)));
}

// Shortens the hit where the ray meets triangle p q r within it.
bool meetsTriangle(GridRay ray, vec3 p, vec3 q, vec3 r, float tMin, inout GridHit hit) {
    vec3 edges = vec3(edgeOf(q, r), edgeOf(r, p), edgeOf(p, q));
    if (!haveOneSign(edges)) return false;
    if (any(equal(edges, vec3(0.0)))) {
        edges = vec3(exactEdgeOf(q, r), exactEdgeOf(r, p), exactEdgeOf(p, q));
        if (!haveOneSign(edges) || edges == vec3(0.0)) return false;
    }
    const float sum = edges.x + edges.y + edges.z;
    const float t = dot(edges, vec3(p.z, q.z, r.z)) / sum * ray.scale;
    if (!(t >= tMin) || !(t < hit.t)) return false;
    hit.t = t;
    hit.weights = edges.yz / sum;
    return true;
}

// The corners of a half of a quad a b c d.
uvec3 halfOf(uvec4 quad, bool isBd, uint half_) {
    if (isBd) return half_ == 0u ? quad.xyw : quad.yzw;
    return half_ == 0u ? quad.xyz : quad.xzw;
}

vec3 triangleNormal(ivec3 p, ivec3 q, ivec3 r) {
    const vec3 stepSize = gridVector(6u);
    return cross(vec3(q - p) * stepSize, vec3(r - p) * stepSize);
}

// The corners a b c d of a quad of a block, as numbers of places.
uvec4 cornersOfQuad(uvec2 steps, uvec2 quad) {
    const uvec2 across = uvec2(placeOfVertex(steps.x, quad.x), placeOfVertex(steps.x, quad.x + 1u));
    const uvec2 down = 5u * uvec2(placeOfVertex(steps.y, quad.y), placeOfVertex(steps.y, quad.y + 1u));
    return uvec4(down.xx + across, down.yy + across.yx);
}

// Which triangles of the block in latticePatch the ray passes within their edges, or may: bit 2 (4 row + column) + half.
uint trianglesOnRay(vec3 places[25], uvec2 steps, uint diagonals) {
    uint found = 0u;
    [[dont_unroll]] for (uint k = 0u; k < 16u; ++k) {
        const uvec2 quad = uvec2(k & 3u, k >> 2);
        if (quad.x >= steps.x || quad.y >= steps.y) continue;
        // From where the diagonal begins.
        uvec4 corners = cornersOfQuad(steps, quad);
        const bool isBd = ((diagonals >> k) & 1u) != 0u;
        if (isBd) corners = corners.yzwx;
        const vec3 p = places[corners.x];
        const vec3 q = places[corners.y];
        const vec3 r = places[corners.z];
        const vec3 s = places[corners.w];
        const float pr = edgeOf(p, r);
        uint halves = haveOneSign(vec3(edgeOf(p, q), edgeOf(q, r), -pr)) ? 1u : 0u;
        if (haveOneSign(vec3(edgeOf(r, s), edgeOf(s, p), pr))) halves |= 2u;
        if (isBd) halves = ((halves & 1u) << 1) | (halves >> 1);
        found |= halves << (2u * k);
    }
    return found;
}

// The block in latticePatch.
bool meetsBlock(LatticeTile tile, uvec2 block, GridRay ray, float tMin, bool anyHit, inout GridHit hit) {
    const uvec2 steps = uvec2(stepsOf(tile.quads.x, block.x), stepsOf(tile.quads.y, block.y));
    const uint diagonals = blockDiagonals(tile, block);
    vec3 places[25];
    [[dont_unroll]] for (uint k = 0u; k < 25u; ++k) places[k] = seen(ray, latticePatch[k]);
    bool isHit = false;
    for (uint left = trianglesOnRay(places, steps, diagonals); left != 0u; left &= left - 1u) {
        const uint bit = uint(findLSB(left));
        const uint k = bit >> 1;
        const uint half_ = bit & 1u;
        const uvec2 quad = uvec2(k & 3u, k >> 2);
        const uvec3 corners = halfOf(cornersOfQuad(steps, quad), ((diagonals >> k) & 1u) != 0u, half_);
        if (!meetsTriangle(ray, places[corners.x], places[corners.y], places[corners.z], tMin, hit)) continue;
        const uvec2 inTile = 4u * block + quad;
        hit.place = inTile.x | (inTile.y << 4) | (half_ << 8);
        hit.normal = triangleNormal(latticePatch[corners.x], latticePatch[corners.y], latticePatch[corners.z]);
        if (anyHit) return true;
        isHit = true;
    }
    return isHit;
}

// The box that a block's byte and the header give.
bool passesBlock(LatticeTile tile, uvec2 block, GridRay ray, float tMin, float tMax) {
    const ivec3 a = blockCorner(tile, block.x, block.y);
    const ivec3 b = blockCorner(tile, block.x + 1u, block.y);
    const ivec3 c = blockCorner(tile, block.x, block.y + 1u);
    const ivec3 d = blockCorner(tile, block.x + 1u, block.y + 1u);
    const uvec3 reach = uvec3(recordWord(tile.record, 2u), recordWord(tile.record, 3u), recordWord(tile.record, 4u)) >> 24u;
    const vec3 unit_ = vec3((reach & 7u) << (reach >> 3u));
    const uint byte = blockByte(tile, block);
    const float low = float((byte >> 2) & 7u);
    const float high = float(byte >> 5);
    const vec3 isDominant = vec3(equal(uvec3(tile.dominant), uvec3(0u, 1u, 2u)));
    const vec3 most = vec3(max(low, high));
    return passesBox(ray, vec3(min(min(a, b), min(c, d))) - unit_ * mix(most, vec3(low), isDominant),
                     vec3(max(max(a, b), max(c, d))) + unit_ * mix(most, vec3(high), isDominant), tMin, tMax);
}

bool meetsTile(uint record, GridRay ray, float tMin, bool anyHit, inout GridHit hit) {
    const LatticeTile tile = latticeTile(record);
    decodeCoarse(tile);
    // First all boxes, then the blocks that are left: so rays side by side decode different ones at a time.
    uint insides[16];
    uint passed = 0u;
    uint inside = tile.insides;
    for (uint k = 0u; k < tile.blocks.x * tile.blocks.y; ++k) {
        const uvec2 block = uvec2(k % tile.blocks.x, k / tile.blocks.x);
        insides[k] = inside;
        inside += insideBits(tile, block);
        if (passesBlock(tile, block, ray, tMin, hit.t)) passed |= 1u << k;
    }
    bool isHit = false;
    for (; passed != 0u; passed &= passed - 1u) {
        const uint k = uint(findLSB(passed));
        const uvec2 block = uvec2(k % tile.blocks.x, k / tile.blocks.x);
        decodeBlock(tile, block, insides[k]);
        if (meetsBlock(tile, block, ray, tMin, anyHit, hit)) isHit = true;
        if (anyHit && isHit) return true;
    }
    return isHit;
}

bool meetsCluster(uint record, GridRay ray, float tMin, bool anyHit, inout GridHit hit) {
    const ClusterHead head = clusterHead(record);
    ClusterWalk walk = clusterWalk(head);
    bool isHit = false;
    while (walk.triangle < head.triangles && !(anyHit && isHit)) {
        const uvec3 corners = nextTriangle(head, walk);
        const ivec3 p = clusterVertex(head, corners.x);
        const ivec3 q = clusterVertex(head, corners.y);
        const ivec3 r = clusterVertex(head, corners.z);
        if (!meetsTriangle(ray, seen(ray, p), seen(ray, q), seen(ray, r), tMin, hit)) continue;
        hit.place = walk.triangle - 1u;
        hit.normal = triangleNormal(p, q, r);
        isHit = true;
    }
    return isHit;
}

const uint gridOffsetsAt = 17u;

// Shortens the hit where the ray meets record `number` from tMin on, before it; `anyHit` ends at the first.
bool meetsRecord(uint number, GridRay ray, float tMin, bool anyHit, inout GridHit hit) {
    const uint offset = word(grids + gridOffsetsAt + number);
    const uint record = word(grids + 15u) + 2u * (offset & 0x7fffffffu);
    const bool isHit = (offset & 0x80000000u) != 0u ? meetsCluster(record, ray, tMin, anyHit, hit)
                                                    : meetsTile(record, ray, tMin, anyHit, hit);
    if (isHit) hit.record = number;
    return isHit;
}
