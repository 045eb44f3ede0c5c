// One sample of one pixel. Rays go through meets() of query.glsl or pipeline.glsl.

vec3 fromArray(float v[3]) {
    return vec3(v[0], v[1], v[2]);
}

Ray cameraRay(uvec2 at, inout RandomStream random) {
    const float y = float(firstRow + at.y) + randomFloat(random);
    const float x = float(at.x) + randomFloat(random);
    const vec3 direction = unit(fromArray(corner) + (fromArray(right) * x + fromArray(down) * y));
    return Ray(fromArray(origin), direction, farthest, kindPrimary, randomBits(random));
}

// `at`: column, and row of those rendered now.
void addSample(uvec2 at) {
    const uint pixel = at.y * width + at.x;
    clearCounts();
    RandomStream random = randomStream(seed, (firstRow + at.y) * width + at.x, sample_);
    Ray ray = cameraRay(at, random);
    Walk walk;
    walk.light = vec3(0.0);
    walk.throughput = vec3(1.0);
    walk.bounce = 0u;
    bool goesOn = true;
    while (goesOn) {
        Place place;
        const bool hit = meets(ray, place);
        if (ray.kind == kindPrimary && hit) ++pixels[pixel].hits;
        goesOn = follow(walk, hit, place, random, ray);
    }
    for (uint channel = 0u; channel < 3u; ++channel) pixels[pixel].light[channel] += walk.light[channel];
    if ((flags & flagCounts) != 0u) addCounts(pixel);
}
