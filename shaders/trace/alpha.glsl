// The any-hit test: alpha from the texture against the cutoff, or a random number for BLEND.

// Texels of a surface: where its words begin, the size, wrap modes, and whether they have 8 bits (four a word, k / 255
// in the table behind the surfaces) or are floats.
struct AlphaTexture {
    uint at;
    uvec2 size;
    uvec2 wrap;
    bool isBytes;
    bool isNearest;
    uint table;
};
AlphaTexture alphaTextureOf(Surface s) {
    const uint sizes = word(s.at + 8u);
    const uint how = word(s.at + 9u);
    return AlphaTexture(word(s.at + 7u), uvec2(sizes & 0xffffu, sizes >> 16) + 1u, uvec2(how & 3u, (how >> 2) & 3u),
                        (how & 16u) != 0u, (how & 32u) != 0u, word(s.at + 10u));
}

float texelOf(AlphaTexture texture_, uint x, uint y) {
    const uint place = y * texture_.size.x + x;
    if (!texture_.isBytes) return real(texture_.at + place);
    const uint byte = (word(texture_.at + (place >> 2)) >> (8u * (place & 3u))) & 255u;
    return real(texture_.table + byte);
}

// At texture coordinates; beyond 2^30 texels anything.
float textureAlpha(AlphaTexture texture_, vec2 coordinates) {
    const vec2 place = coordinates * vec2(texture_.size) - (texture_.isNearest ? 0.0 : 0.5);
    const vec2 low = clamp(floor(place), -1e9, 1e9);
    const ivec2 texel = ivec2(low);
    const uint left = wrapTexel(texel.x, texture_.size.x, texture_.wrap.x);
    const uint bottom = wrapTexel(texel.y, texture_.size.y, texture_.wrap.y);
    if (texture_.isNearest) return texelOf(texture_, left, bottom);
    const uint right = wrapTexel(texel.x + 1, texture_.size.x, texture_.wrap.x);
    const uint top = wrapTexel(texel.y + 1, texture_.size.y, texture_.wrap.y);
    const vec2 part = place - low;
    const float leftBottom = texelOf(texture_, left, bottom);
    const float leftTop = texelOf(texture_, left, top);
    const precise float lower = leftBottom + (texelOf(texture_, right, bottom) - leftBottom) * part.x;
    const precise float upper = leftTop + (texelOf(texture_, right, top) - leftTop) * part.x;
    const precise float alpha = lower + (upper - lower) * part.y;
    return alpha;
}

// Alpha times the vertices' and the material's.
float alphaAt(Surface s, uint triangle, vec2 weights) {
    const uvec3 corners = cornersOf(s, triangle);
    float scale = real(s.at + 6u);
    if (hasVertexAlphas(s)) {
        const uint first = word(s.at + 4u);
        const float a = real(first + corners.x);
        scale *= a + weights.x * (real(first + corners.y) - a) + weights.y * (real(first + corners.z) - a);
    }
    if (word(s.at + 7u) == none) return scale;
    return textureAlpha(alphaTextureOf(s), coordinatesAt(s, corners, weights)) * scale;
}

bool textureAccepts(Surface s, uint triangle, uint instance, vec2 weights, uint seed) {
    const float alpha = alphaAt(s, triangle, weights);
    if (!isBlended(s)) return alpha >= real(s.at + 5u);
    // One number for each ray and place, so that the order of candidates does not matter.
    const uint place = hashed(triangle, hashed(instance, s.number));
    const uint point = hashed(floatBitsToUint(weights.x), floatBitsToUint(weights.y));
    return alpha > unitFloat(hashed(seed, hashed(place, point)));
}
