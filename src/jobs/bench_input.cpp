#include "jobs/bench_input.h"

#include "filigree/core/bytes.h"
#include "filigree/core/file.h"

#include "jobs/random.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr uint32_t side = 1024;  // texels

// How far inside a lobed, toothed leaf the point (x, y) of [-1, 1]^2 lies, in about the same units; negative
// outside.
double insideLeaf(double x, double y) {
    const double angle = std::atan2(x, -y);
    const double radius = std::hypot(x, y);
    const double lobes = 0.62 + 0.2 * std::cos(5 * angle) + 0.05 * std::cos(15 * angle);
    const double teeth = 0.018 * std::cos(61 * angle);
    const double stem = std::min(0.025 - std::fabs(x), std::min(0.95 - y, y));
    const double holes =
        std::hypot(std::fmod(std::fabs(x), 0.17) - 0.085, std::fmod(std::fabs(y), 0.19) - 0.095) - 0.012;
    return std::max(std::min(lobes + teeth - radius, holes), stem);
}

image::AlphaTexture makeLeaf() {
    std::vector<uint8_t> texels(size_t{side} * side);
    for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) {
            const double px = (x + 0.5) * 2 / side - 1;
            const double py = (y + 0.5) * 2 / side - 1;
            const double texelsInside = insideLeaf(px, py) * side / 2;
            const double alpha = std::clamp(0.5 + texelsInside / 2, 0.0, 1.0);
            texels[size_t{y} * side + x] = static_cast<uint8_t>(std::lround(alpha * 255));
        }
    }
    image::AlphaTexture texture;
    texture.image = image::alphaImageFrom8Bit(side, side, texels);
    return texture;
}

mesh::Uv uvAt(double u, double v) {
    return {static_cast<float>(u), static_cast<float>(v)};
}

std::vector<mesh::UvTriangle> makeRandomTriangles(size_t count) {
    Random random(1);
    std::vector<mesh::UvTriangle> triangles(count);
    for (mesh::UvTriangle& t : triangles) {
        const double u = random.uniform(0, 1);
        const double v = random.uniform(0, 1);
        const double turn = random.uniform(0, 2 * std::numbers::pi);
        const double opening = random.uniform(0.6, 1.8);
        const double first = random.uniform(64, 256) / side;
        const double second = random.uniform(64, 256) / side;
        t.uv = {uvAt(u, v), uvAt(u + first * std::cos(turn), v + first * std::sin(turn)),
                uvAt(u + second * std::cos(turn + opening), v + second * std::sin(turn + opening))};
    }
    return triangles;
}

Result<std::vector<mesh::UvTriangle>> readTriangles(const std::filesystem::path& folder,
                                                    const std::string& name) {
    const auto uvPath = folder / (name + ".uv.f32");
    const auto indexPath = folder / (name + ".idx.u32");
    auto uvs = readFile(uvPath);
    if (!uvs) return uvs.error();
    auto indices = readFile(indexPath);
    if (!indices) return indices.error();
    const size_t vertices = uvs->size() / 8;
    if (uvs->size() % 8 != 0)
        return Error{ErrorKind::format, uvPath.string() + ": expected pairs of 4-byte floats"};
    if (indices->size() % 12 != 0) {
        return Error{ErrorKind::format, indexPath.string() + ": expected three 4-byte indices a triangle"};
    }
    std::vector<mesh::UvTriangle> triangles(indices->size() / 12);
    for (size_t corner = 0; corner < 3 * triangles.size(); ++corner) {
        const auto vertex = loadLe<uint32_t>(&(*indices)[4 * corner]);
        if (vertex >= vertices) {
            return Error{ErrorKind::format, fmt::format("{}: index {} is {}, there are {} vertices",
                                                        indexPath.string(), corner, vertex, vertices)};
        }
        triangles[corner / 3].uv[corner % 3] = {
            std::bit_cast<float>(loadLe<uint32_t>(&(*uvs)[8 * vertex])),
            std::bit_cast<float>(loadLe<uint32_t>(&(*uvs)[8 * vertex + 4]))};
    }
    return triangles;
}

}  // namespace

BenchInput makeBenchInput() {
    const std::array<mesh::Uv, 4> corner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    BenchInput input;
    input.texture = makeLeaf();
    input.quad = {{{corner[0], corner[1], corner[2]}}, {{corner[0], corner[2], corner[3]}}};
    input.rand20k = makeRandomTriangles(20000);
    return input;
}

Result<BenchInput> readBenchInput(const std::filesystem::path& folder) {
    const auto path = folder / "leaf_1024x1024.u8";
    auto leaf = readFile(path);
    if (!leaf) return leaf.error();
    if (leaf->size() != size_t{side} * side) {
        return Error{ErrorKind::format,
                     fmt::format("{}: {} bytes, expected {} x {}", path.string(), leaf->size(), side, side)};
    }
    BenchInput input;
    input.texture.image = image::alphaImageFrom8Bit(side, side, *leaf);
    auto quad = readTriangles(folder, "quad");
    if (!quad) return quad.error();
    auto random = readTriangles(folder, "rand20k");
    if (!random) return random.error();
    input.quad = std::move(*quad);
    input.rand20k = std::move(*random);
    return input;
}

}  // namespace filigree::jobs
