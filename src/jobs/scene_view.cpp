#include "jobs/scene_view.h"

#include "filigree/core/vec3.h"

#include "jobs/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace filigree::jobs {
namespace {

constexpr uint32_t samples = 2;        // along each axis of a pixel
constexpr uint32_t shadowSide = 2048;  // texels of the sun's view
constexpr double shadowReach = 15;     // metres about the origin that the sun's view covers
constexpr double shadowBias = 0.03;    // metres
constexpr Vec3 sunlight{2.6F, 2.35F, 1.9F};
constexpr Vec3 skylight{0.42F, 0.52F, 0.66F};
constexpr Vec3 groundlight{0.16F, 0.17F, 0.11F};
constexpr Vec3 haze{1.75F, 2.05F, 2.4F};
constexpr Vec3 zenith{0.35F, 0.75F, 1.6F};
constexpr float hazePerMetre = 0.0015F;

const Vec3 sunDirection = normalised({-0.45F, -0.75F, -0.42F});  // the way its light goes

Vec3 product(const Vec3& a, const Vec3& b) {
    return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}
Vec3 blended(const Vec3& a, const Vec3& b, float share) {
    return plus(times(a, 1 - share), times(b, share));
}

// The curve of sRGB (IEC 61966-2-1).
float linearOf(uint8_t value) {
    const float c = static_cast<float>(value) / 255;
    return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

uint8_t encoded(float value) {
    const float c = std::clamp(value, 0.0F, 1.0F);
    const float s = c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1 / 2.4F) - 0.055F;
    return static_cast<uint8_t>(std::lround(s * 255));
}

// A gentle shoulder, so that sunlit leaves keep their colour.
Colour toneMapped(const Vec3& c) {
    const auto map = [](float v) { return encoded(1 - std::exp(-v)); };
    return {map(c[0]), map(c[1]), map(c[2])};
}

class Shader {
  public:
    Shader(const scene::Scene& scene, const scene::Camera& camera)
        : scene_(scene),
          triangles_(worldTriangles(scene)),
          eye_{camera.transform[12], camera.transform[13], camera.transform[14]},
          sunView_(Projection::parallel(sunDirection, {0, 1, -2}, shadowReach)),
          sunSees_(findVisible(triangles_, scene, sunView_, shadowSide, shadowSide)) {
        for (size_t i = 0; i < toLinear_.size(); ++i) toLinear_[i] = linearOf(static_cast<uint8_t>(i));
    }

    [[nodiscard]] const std::vector<WorldTriangle>& triangles() const { return triangles_; }

    [[nodiscard]] Vec3 shade(const Visibility& seen, size_t pixel) const {
        const WorldTriangle& t = triangles_[seen.triangle[pixel]];
        const float b1 = seen.weights[pixel][0];
        const float b2 = seen.weights[pixel][1];
        const Vec3 e1 = minus(t.position[1], t.position[0]);
        const Vec3 e2 = minus(t.position[2], t.position[0]);
        const Vec3 place = plus(t.position[0], plus(times(e1, b1), times(e2, b2)));
        const Vec3 view = minus(place, eye_);
        Vec3 normal = cross(e1, e2);
        normal = dot(normal, normal) > 0 ? normalised(normal) : Vec3{0, 1, 0};
        if (dot(normal, view) > 0) normal = times(normal, -1);
        const Vec3 lit = product(albedo(t, b1, b2), lightAt(place, normal, isThin(t)));
        return blended(lit, haze, 1 - std::exp(-hazePerMetre * std::sqrt(dot(view, view))));
    }

  private:
    [[nodiscard]] bool isThin(const WorldTriangle& t) const {
        return t.material >= 0 &&
               scene_.materials[static_cast<size_t>(t.material)].alphaMode != scene::AlphaMode::opaque;
    }

    [[nodiscard]] Vec3 albedo(const WorldTriangle& t, float b1, float b2) const {
        if (t.material < 0) return {0.5F, 0.5F, 0.5F};
        const auto& m = scene_.materials[static_cast<size_t>(t.material)];
        const Vec3 factor{m.baseColourFactor[0], m.baseColourFactor[1], m.baseColourFactor[2]};
        if (m.image < 0 || !scene_.images[static_cast<size_t>(m.image)].colour) return factor;
        const scene::ColourImage& image = *scene_.images[static_cast<size_t>(m.image)].colour;
        const auto texel = [](float a, float b, float c, float w1, float w2, uint32_t size,
                              image::Wrap wrap) {
            const double at = (double{a} + w1 * (double{b} - a) + w2 * (double{c} - a)) * size;
            return image::wrapTexel(static_cast<int64_t>(std::floor(at)), size, wrap);
        };
        const uint32_t x = texel(t.uv[0].u, t.uv[1].u, t.uv[2].u, b1, b2, image.width, m.wrapU);
        const uint32_t y = texel(t.uv[0].v, t.uv[1].v, t.uv[2].v, b1, b2, image.height, m.wrapV);
        const uint8_t* rgba = &image.rgba[4 * (size_t{y} * image.width + x)];
        return product(factor, {toLinear_[rgba[0]], toLinear_[rgba[1]], toLinear_[rgba[2]]});
    }

    // Thin things let some of the sun through from behind.
    [[nodiscard]] Vec3 lightAt(const Vec3& place, const Vec3& normal, bool thin) const {
        const float facing = -dot(normal, sunDirection);
        const float direct = facing > 0 ? facing : thin ? -0.55F * facing : 0;
        const Vec3 sky = blended(groundlight, skylight, 0.5F + 0.5F * normal[1]);
        return plus(sky, times(sunlight, direct * sunShare(place)));
    }

    // How much of the sun reaches a place: the mean of nine looks at the sun's view.
    [[nodiscard]] float sunShare(const Vec3& place) const {
        const ClipPoint p = sunView_(place);
        const auto x = static_cast<int64_t>(std::floor((p.x + 1) / 2 * shadowSide));
        const auto y = static_cast<int64_t>(std::floor((1 - p.y) / 2 * shadowSide));
        int lit = 0;
        for (int64_t dy = -1; dy <= 1; ++dy) {
            for (int64_t dx = -1; dx <= 1; ++dx) {
                const int64_t sx = x + dx;
                const int64_t sy = y + dy;
                const bool inside = sx >= 0 && sy >= 0 && sx < shadowSide && sy < shadowSide;
                if (!inside || sunSees_.depth[static_cast<size_t>(sy * shadowSide + sx)] > p.z - shadowBias)
                    ++lit;
            }
        }
        return static_cast<float>(lit) / 9;
    }

    const scene::Scene& scene_;
    std::vector<WorldTriangle> triangles_;
    Vec3 eye_;
    Projection sunView_;
    Visibility sunSees_;
    std::array<float, 256> toLinear_{};
};

// Paler towards the horizon; `height` is 0 at the picture's foot, 1 at its top.
Vec3 skyAt(float height) {
    return blended(haze, zenith, std::clamp(1.4F * (height - 0.35F), 0.0F, 1.0F));
}

}  // namespace

Canvas drawView(const scene::Scene& scene, const scene::Camera& camera, uint32_t width, uint32_t height,
                const Executor& executor) {
    const Shader shader(scene, camera);
    const auto projection = Projection::perspective(camera, static_cast<double>(width) / height);
    const Visibility seen =
        findVisible(shader.triangles(), scene, projection, width * samples, height * samples);
    Canvas canvas(width, height, {0, 0, 0});
    executor.parallelFor(height, 16, [&](size_t begin, size_t end) {
        for (auto y = static_cast<uint32_t>(begin); y < end; ++y) {
            const Vec3 sky = skyAt(1 - static_cast<float>(y) / static_cast<float>(height));
            for (uint32_t x = 0; x < width; ++x) {
                Vec3 sum{};
                for (uint32_t s = 0; s < samples * samples; ++s) {
                    const size_t row = size_t{y} * samples + s / samples;
                    const size_t pixel = row * seen.width + size_t{x} * samples + s % samples;
                    const bool hit = seen.triangle[pixel] != Visibility::nothing;
                    sum = plus(sum, hit ? shader.shade(seen, pixel) : sky);
                }
                canvas.set(x, y, toneMapped(times(sum, 1.0F / (samples * samples))));
            }
        }
    });
    return canvas;
}

}  // namespace filigree::jobs
