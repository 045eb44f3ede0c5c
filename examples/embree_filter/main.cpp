// Masked quads under Embree, their alpha tested by a filter function with micromaps. Rays must meet what they
// meet where every test asks the texture, and few tests may still ask it.
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>
#include <vector>

#include <embree3/rtcore.h>
#include <filigree/bake.h>
#include <filigree/encoding.h>

namespace {

using namespace filigree;

constexpr unsigned quadCount = 40;
constexpr uint32_t textureSide = 128;
constexpr double cutoff = 0.5;

// What a filter call needs. The reader looks into `maps`.
struct Masked {
    std::vector<mesh::UvTriangle> triangles;
    image::AlphaTexture texture;
    encoding::EncodedSet maps;
    std::vector<int32_t> indices;  // [triangles], a map or a special index
    std::unique_ptr<encoding::MapReader> reader;
    bool usesMaps = true;
    uint64_t textureTests = 0;
};

// ---- The filter

bool textureIsOpaque(Masked& masked, unsigned triangle, float u, float v) {
    ++masked.textureTests;
    const auto& [a, b, c] = masked.triangles[triangle].uv;
    const double s = (1 - u - v) * a.u + u * b.u + v * c.u;
    const double t = (1 - u - v) * a.v + u * b.v + v * c.v;
    return image::sampleBilinear(masked.texture, s * textureSide, t * textureSide) >= cutoff;
}

micromap::State stateAt(const Masked& masked, unsigned triangle, float u, float v) {
    const int32_t index = masked.indices[triangle];
    if (micromap::isSpecialIndex(index)) return micromap::stateOfSpecialIndex(index);
    return masked.reader->at(static_cast<uint32_t>(index), u, v);
}

bool isOpaque(Masked& masked, unsigned triangle, float u, float v) {
    if (!masked.usesMaps) return textureIsOpaque(masked, triangle, u, v);
    const micromap::State state = stateAt(masked, triangle, u, v);
    return micromap::isKnown(state) ? micromap::isOpaqueSide(state) : textureIsOpaque(masked, triangle, u, v);
}

// For single rays: Embree's u and v weigh vertices 1 and 2, as a micromap's do.
void filter(const RTCFilterFunctionNArguments* call) {
    if (call->valid[0] == 0) return;
    auto& masked = *static_cast<Masked*>(call->geometryUserPtr);
    const unsigned triangle = RTCHitN_primID(call->hit, call->N, 0);
    if (!isOpaque(masked, triangle, RTCHitN_u(call->hit, call->N, 0), RTCHitN_v(call->hit, call->N, 0)))
        call->valid[0] = 0;
}

// ---- A scene to try it on

// Four leaves, soft at their edges.
image::AlphaTexture makeTexture() {
    std::vector<uint8_t> alpha(textureSide * textureSide);
    for (uint32_t k = 0; k < alpha.size(); ++k) {
        const double x = std::abs(std::fmod(k % textureSide, 64) - 31.5) / 32;
        const double y = std::fmod(k / textureSide, 64) / 64;
        const double inside = 1.6 * y * (1 - y) - x + 0.5;
        alpha[k] = static_cast<uint8_t>(255 * std::min(1.0, std::max(0.0, 8 * (inside - 0.5) + 0.5)));
    }
    return {image::alphaImageFrom8Bit(textureSide, textureSide, alpha)};
}

// Triangle k of two a quad: its corners of the unit square.
constexpr std::array<std::array<std::array<float, 2>, 3>, 2> halves{
    {{{{0, 0}, {1, 0}, {1, 1}}}, {{{0, 0}, {1, 1}, {0, 1}}}}};

// Quads one behind the other, each turned a little further; three vertices a triangle.
RTCGeometry makeQuads(RTCDevice device, Masked& masked) {
    const RTCGeometry quads = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* at = static_cast<float*>(rtcSetNewGeometryBuffer(
        quads, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 6 * quadCount));
    auto* index = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        quads, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), 2 * quadCount));
    for (uint32_t k = 0; k < 6 * quadCount; ++k) {
        const auto& [x, y] = halves[k / 3 % 2][k % 3];
        const float angle = 0.1F * static_cast<float>(k / 6);
        *at++ = std::cos(angle) * (x - 0.5F) - std::sin(angle) * (y - 0.5F);
        *at++ = std::sin(angle) * (x - 0.5F) + std::cos(angle) * (y - 0.5F);
        *at++ = 1 + 0.1F * static_cast<float>(k / 6);
        *index++ = k;
        if (k % 3 == 0) masked.triangles.emplace_back();
        masked.triangles.back().uv[k % 3] = {x, y};
    }
    return quads;
}

Status makeMaps(Masked& masked) {
    const auto baked = bake::bake(masked.triangles, masked.texture, {.cutoff = cutoff});
    if (!baked) return baked.error();
    std::vector<micromap::QuadtreeView> trees;
    for (size_t k = 0; k < baked->set.trees.size(); ++k) trees.push_back(baked->set.trees[k]);
    auto maps = encoding::encode(encoding::Encoding::sdag, trees, micromap::Format::fourState);
    if (!maps) return maps.error();
    masked.maps = std::move(*maps);
    masked.indices = baked->set.indices;
    auto reader = encoding::openReader(encoding::viewOf(masked.maps));
    if (!reader) return reader.error();
    masked.reader = std::move(*reader);
    return {};
}

// The triangle that each ray of a square bundle meets; RTC_INVALID_GEOMETRY_ID for none.
std::vector<unsigned> trace(RTCScene scene) {
    std::vector<unsigned> met;
    for (unsigned k = 0; k < 256 * 256; ++k) {
        RTCRayHit ray{};
        ray.ray.org_x = (static_cast<float>(k % 256) - 127.5F) / 256;
        ray.ray.org_y = (static_cast<float>(k / 256) - 127.5F) / 256;
        ray.ray.dir_x = 0.01F;
        ray.ray.dir_z = 1;
        ray.ray.tfar = std::numeric_limits<float>::infinity();
        ray.ray.mask = ~0U;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene, &context, &ray);
        met.push_back(ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? RTC_INVALID_GEOMETRY_ID : ray.hit.primID);
    }
    return met;
}

}  // namespace

int main() {
    Masked masked;
    masked.texture = makeTexture();
    const RTCDevice device = rtcNewDevice(nullptr);
    const RTCScene scene = rtcNewScene(device);
    const RTCGeometry quads = makeQuads(device, masked);
    if (const auto made = makeMaps(masked); !made.ok()) return std::cerr << made.error().message << '\n', 1;
    rtcSetGeometryUserData(quads, &masked);
    rtcSetGeometryIntersectFilterFunction(quads, filter);
    rtcSetGeometryOccludedFilterFunction(quads, filter);
    rtcCommitGeometry(quads);
    rtcAttachGeometry(scene, quads);
    rtcReleaseGeometry(quads);
    rtcCommitScene(scene);

    const auto withMaps = trace(scene);
    const uint64_t asked = masked.textureTests;
    masked.usesMaps = false;
    masked.textureTests = 0;
    const auto withTexture = trace(scene);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);

    const bool same = withMaps == withTexture;
    const bool fewer = asked * 10 < masked.textureTests;
    std::cout << (same ? "every ray meets the same triangle" : "RAYS DIFFER") << '\n'
              << (fewer ? "less than a tenth of the tests ask the texture" : "MICROMAPS SAVE TOO LITTLE")
              << '\n';
    return same && fewer ? 0 : 1;
}
