#include "jobs/visibility.h"

#include "jobs/alpha_source.h"
#include "jobs/canvas.h"

#include <cmath>
#include <limits>
#include <optional>

namespace filigree::jobs {
namespace {

constexpr double nearest = 0.02;  // metres: what is closer to the camera is cut away

Vec3 column(const std::array<float, 16>& m, size_t c) {
    return {m[4 * c], m[4 * c + 1], m[4 * c + 2]};
}

// A row of the matrix: the part of a point along `axis`, seen from `origin`, times `scale`.
std::array<double, 4> rowAlong(const Vec3& axis, const Vec3& origin, double scale) {
    return {scale * axis[0], scale * axis[1], scale * axis[2], -scale * double{dot(axis, origin)}};
}

struct Corner {
    ClipPoint at;
    Weights weights;
};

Corner between(const Corner& a, const Corner& b, double t) {
    const auto mix = [t](double x, double y) { return x + t * (y - x); };
    Corner c;
    c.at = {mix(a.at.x, b.at.x), mix(a.at.y, b.at.y), mix(a.at.z, b.at.z), mix(a.at.w, b.at.w)};
    for (size_t k = 0; k < 3; ++k) c.weights[k] = mix(a.weights[k], b.weights[k]);
    return c;
}

// What of the triangle lies in front of the near plane: 0, 3 or 4 corners (Sutherland and Hodgman 1974).
std::vector<Corner> clipped(const std::array<Corner, 3>& corners) {
    std::vector<Corner> kept;
    for (size_t k = 0; k < 3; ++k) {
        const Corner& a = corners[k];
        const Corner& b = corners[(k + 1) % 3];
        if (a.at.w >= nearest) kept.push_back(a);
        if ((a.at.w >= nearest) != (b.at.w >= nearest)) {
            kept.push_back(between(a, b, (nearest - a.at.w) / (b.at.w - a.at.w)));
        }
    }
    return kept;
}

// The alpha test of each MASK material.
struct AlphaCheck {
    image::AlphaTexture texture;
    image::AlphaTest test;

    [[nodiscard]] bool passes(const WorldTriangle& t, const Weights& w) const {
        double u = 0;
        double v = 0;
        for (size_t k = 0; k < 3; ++k) {
            u += w[k] * double{t.uv[k].u};
            v += w[k] * double{t.uv[k].v};
        }
        const double alpha =
            image::sampleBilinear(texture, u * texture.image.width, v * texture.image.height);
        return alpha * test.factor >= test.cutoff;
    }
};

std::vector<std::optional<AlphaCheck>> alphaChecks(const scene::Scene& scene) {
    std::vector<std::optional<AlphaCheck>> checks(scene.materials.size());
    for (size_t m = 0; m < checks.size(); ++m) {
        if (scene.materials[m].alphaMode != scene::AlphaMode::mask) continue;
        const AlphaSource source = sourceOf(scene.materials[m]);
        checks[m] = AlphaCheck{textureOf(scene, source), source.test};
    }
    return checks;
}

class Rasteriser {
  public:
    Rasteriser(const scene::Scene& scene, Visibility& out) : checks_(alphaChecks(scene)), out_(out) {}

    void draw(const WorldTriangle& triangle, uint32_t id, const Projection& projection) {
        std::array<Corner, 3> corners{};
        for (size_t k = 0; k < 3; ++k) {
            corners[k].at = projection(triangle.position[k]);
            corners[k].weights[k] = 1;
        }
        const std::vector<Corner> kept = clipped(corners);
        for (size_t k = 2; k < kept.size(); ++k) drawPart({kept[0], kept[k - 1], kept[k]}, triangle, id);
    }

  private:
    void drawPart(const std::array<Corner, 3>& c, const WorldTriangle& triangle, uint32_t id) {
        std::array<Pixel, 3> p{};
        for (size_t k = 0; k < 3; ++k) {
            p[k] = {(c[k].at.x / c[k].at.w + 1) / 2 * out_.width,
                    (1 - c[k].at.y / c[k].at.w) / 2 * out_.height};
        }
        const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
        if (area == 0) return;
        const AlphaCheck* check = checkOf(triangle);
        forEachSpan(p, out_.width, out_.height, [&](uint32_t y, uint32_t first, uint32_t end) {
            for (uint32_t x = first; x < end; ++x) {
                const double b1 =
                    ((x + 0.5 - p[0].x) * (p[2].y - p[0].y) - (y + 0.5 - p[0].y) * (p[2].x - p[0].x)) / area;
                const double b2 =
                    ((p[1].x - p[0].x) * (y + 0.5 - p[0].y) - (p[1].y - p[0].y) * (x + 0.5 - p[0].x)) / area;
                drawPixel(size_t{y} * out_.width + x, c, {1 - b1 - b2, b1, b2}, triangle, id, check);
            }
        });
    }

    const AlphaCheck* checkOf(const WorldTriangle& triangle) const {
        if (triangle.material < 0) return nullptr;
        const auto& check = checks_[static_cast<size_t>(triangle.material)];
        return check ? &*check : nullptr;
    }

    // `screen` weighs the corners on the picture; 1 / w turns that into weights on the triangle.
    void drawPixel(size_t pixel, const std::array<Corner, 3>& c, const Weights& screen,
                   const WorldTriangle& triangle, uint32_t id, const AlphaCheck* check) {
        double depth = 0;
        double inverse = 0;
        for (size_t k = 0; k < 3; ++k) {
            depth += screen[k] * c[k].at.z / c[k].at.w;
            inverse += screen[k] / c[k].at.w;
        }
        if (depth >= out_.depth[pixel]) return;
        Weights weights{};
        for (size_t corner = 0; corner < 3; ++corner) {
            for (size_t k = 0; k < 3; ++k)
                weights[k] += screen[corner] / c[corner].at.w / inverse * c[corner].weights[k];
        }
        if (check != nullptr && !check->passes(triangle, weights)) return;
        out_.depth[pixel] = depth;
        out_.triangle[pixel] = id;
        out_.weights[pixel] = {static_cast<float>(weights[1]), static_cast<float>(weights[2])};
    }

    std::vector<std::optional<AlphaCheck>> checks_;
    Visibility& out_;
};

}  // namespace

std::vector<WorldTriangle> worldTriangles(const scene::Scene& scene) {
    std::vector<WorldTriangle> triangles;
    for (const auto& instance : scene.instances) {
        for (const auto& primitive : scene.meshes[instance.mesh].primitives) {
            for (size_t t = 0; t < primitive.triangleCount(); ++t) {
                WorldTriangle out{{}, primitive.uvTriangle(t).uv, primitive.material};
                for (size_t k = 0; k < 3; ++k) {
                    out.position[k] =
                        transformed(instance.transform, primitive.positions[primitive.indices[3 * t + k]]);
                }
                triangles.push_back(out);
            }
        }
    }
    return triangles;
}

// z is -1, so that z / w rises with the distance and is linear over the picture.
Projection Projection::perspective(const scene::Camera& camera, double aspect) {
    const double zoom = 1 / std::tan(double{camera.verticalFov} / 2);
    const Vec3 eye = column(camera.transform, 3);
    Projection p;
    p.rows_[0] = rowAlong(column(camera.transform, 0), eye, zoom / aspect);
    p.rows_[1] = rowAlong(column(camera.transform, 1), eye, zoom);
    p.rows_[2] = {0, 0, 0, -1};
    p.rows_[3] = rowAlong(column(camera.transform, 2), eye, -1);
    return p;
}

Projection Projection::parallel(const Vec3& direction, const Vec3& centre, double reach) {
    const Vec3 right = normalised(cross(direction, {0, 1, 0}));
    Projection p;
    p.rows_[0] = rowAlong(right, centre, 1 / reach);
    p.rows_[1] = rowAlong(cross(right, direction), centre, 1 / reach);
    p.rows_[2] = rowAlong(direction, centre, 1);
    p.rows_[3] = {0, 0, 0, 1};
    return p;
}

ClipPoint Projection::operator()(const Vec3& p) const {
    const auto row = [&](size_t r) {
        return rows_[r][0] * p[0] + rows_[r][1] * p[1] + rows_[r][2] * p[2] + rows_[r][3];
    };
    return {row(0), row(1), row(2), row(3)};
}

Visibility findVisible(const std::vector<WorldTriangle>& triangles, const scene::Scene& scene,
                       const Projection& projection, uint32_t width, uint32_t height) {
    const size_t pixels = size_t{width} * height;
    Visibility out{width, height, std::vector<uint32_t>(pixels, Visibility::nothing),
                   std::vector<double>(pixels, std::numeric_limits<double>::infinity()),
                   std::vector<std::array<float, 2>>(pixels)};
    Rasteriser rasteriser(scene, out);
    for (size_t t = 0; t < triangles.size(); ++t) {
        rasteriser.draw(triangles[t], static_cast<uint32_t>(t), projection);
    }
    return out;
}

}  // namespace filigree::jobs
