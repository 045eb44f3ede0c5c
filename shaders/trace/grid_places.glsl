// What a ray sees where it hits a grid.

vec3 normalOfVertex(uint first, uint vertex) {
    const uint at = first + 3u * vertex;
    return vec3(real(at), real(at + 1u), real(at + 2u));
}
vec3 blendedNormal(uint first, uvec3 vertices, vec2 weights) {
    return (1.0 - weights.x - weights.y) * normalOfVertex(first, vertices.x) +
           weights.x * normalOfVertex(first, vertices.y) + weights.y * normalOfVertex(first, vertices.z);
}

// From the vertices' normals; zero where there are none.
vec3 smoothNormal(GridHit hit) {
    const uint at = word(grids + 16u);
    if (at == none) return vec3(0.0);
    const uint offset = word(grids + gridOffsetsAt + hit.record);
    const uint record = word(grids + 15u) + 2u * (offset & 0x7fffffffu);
    if ((offset & 0x80000000u) != 0u) {
        if (word(at + 1u) == none) return vec3(0.0);
        const uint corners = word(at + 2u) + 3u * (recordWord(record, 0u) + hit.place);
        return blendedNormal(word(at + 1u), uvec3(word(corners), word(corners + 1u), word(corners + 2u)), hit.weights);
    }
    if (word(at) == none) return vec3(0.0);
    const LatticeTile tile = latticeTile(record);
    const uvec2 quad = uvec2(hit.place & 15u, (hit.place >> 4) & 15u);
    const uint where = recordWord(record, 1u);
    const uvec2 inGrid = 16u * uvec2(where & 0xfffu, (where >> 12) & 0xfffu) + quad;
    const uint grid = at + 3u + 2u * (recordWord(record, 0u) & 0xffffffu);
    const uint columns = word(grid);
    const uint a = word(grid + 1u) + inGrid.y * columns + inGrid.x;
    const uvec4 corners = a + uvec4(0u, 1u, columns + 1u, columns);
    return blendedNormal(word(at), halfOf(corners, latticeDiagonal(tile, quad.x, quad.y), hit.place >> 8), hit.weights);
}

// `direction` and `origin` of the ray, world units.
Place placeOnGrid(GridHit hit, vec3 origin, vec3 direction) {
    vec3 normal = dot(hit.normal, hit.normal) > 0.0 ? unit(hit.normal) : -direction;
    if (dot(normal, direction) > 0.0) normal = -normal;
    const vec3 smooth_ = smoothNormal(hit);
    if (dot(smooth_, smooth_) > 0.0) {
        const vec3 bent = unit(smooth_);
        normal = dot(bent, normal) < 0.0 ? -bent : bent;
    }
    return Place(origin + direction * hit.t, normal, gridAlbedo);
}
