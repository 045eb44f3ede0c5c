#include "vulkan/scene_words.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <span>

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

bool isWhole(const std::array<float, 3>& position) {
    return std::ranges::all_of(position, [](float x) { return std::isfinite(x); });
}

uint32_t packedSize(uint32_t width, uint32_t height) {
    return (width - 1) | (height - 1) << 16;
}

// Lays out one scene.
class SceneWriter {
  public:
    SceneWriter(const scene::Scene& scene, bool opaque) : scene_(scene), opaque_(opaque) {}

    Result<SceneWords> run() {
        countSurfaces();
        made_.words.resize(made_.surfaces.size() * sizeof(SurfaceWords) / 4);
        tablesAt_ = here();
        addTables();
        for (size_t k = 0; k < made_.surfaces.size(); ++k) {
            describe(*made_.primitives[k], made_.surfaces[k]);
            if (made_.words.size() > mostSceneWords)
                return Error{ErrorKind::limit, "the scene's geometry and textures take more than 4 GiB"};
        }
        if (!made_.surfaces.empty()) {
            std::memcpy(made_.words.data(), made_.surfaces.data(),
                        made_.surfaces.size() * sizeof(SurfaceWords));
        }
        return std::move(made_);
    }

  private:
    [[nodiscard]] uint32_t here() const { return static_cast<uint32_t>(made_.words.size()); }
    void add(float value) { made_.words.push_back(std::bit_cast<uint32_t>(value)); }

    void countSurfaces() {
        for (const scene::Mesh& mesh : scene_.meshes) {
            made_.firstSurface.push_back(static_cast<uint32_t>(made_.primitives.size()));
            for (const scene::Primitive& primitive : mesh.primitives) {
                if (primitive.triangleCount() > 0 && isWanted(primitive))
                    made_.primitives.push_back(&primitive);
            }
        }
        made_.firstSurface.push_back(static_cast<uint32_t>(made_.primitives.size()));
        made_.surfaces.resize(made_.primitives.size());
    }

    [[nodiscard]] bool isWanted(const scene::Primitive& primitive) const {
        if (opaque_) return true;
        return primitive.material >= 0 &&
               scene_.materials[static_cast<size_t>(primitive.material)].alphaMode !=
                   scene::AlphaMode::opaque;
    }

    // Division and powers of devices are not exact.
    void addTables() {
        for (int k = 0; k < 256; ++k) add(static_cast<float>(k / 255.0));
        for (int k = 0; k < 256; ++k) {
            const float c = static_cast<float>(k) / 255;
            add(c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F));
        }
    }

    void describe(const scene::Primitive& primitive, SurfaceWords& surface) {
        surface.tablesAt = tablesAt_;
        surface.indicesAt = here();
        made_.words.insert(made_.words.end(), primitive.indices.begin(), primitive.indices.end());
        surface.positionsAt = here();
        for (const auto& position : primitive.positions) addPosition(position);
        if (primitive.material >= 0) describeMaterial(primitive, surface);
    }

    // A triangle with a vertex whose x is not a number is no triangle to the device.
    void addPosition(const std::array<float, 3>& position) {
        const bool whole = isWhole(position);
        for (const float x : position) add(whole ? x : std::numeric_limits<float>::quiet_NaN());
    }

    void describeMaterial(const scene::Primitive& primitive, SurfaceWords& surface) {
        const scene::Material& material = scene_.materials[static_cast<size_t>(primitive.material)];
        surface.kind = static_cast<uint32_t>(material.alphaMode);
        surface.cutoff = static_cast<float>(material.cutoff);
        surface.factor = material.baseColourFactor[3];
        for (size_t k = 0; k < 3; ++k) surface.colour[k] = material.baseColourFactor[k];
        if (!primitive.alphas.empty()) {
            surface.alphasAt = here();
            for (const float alpha : primitive.alphas) add(alpha);
        }
        if (primitive.uvs.empty()) return;
        surface.coordinatesAt = here();
        for (const mesh::Uv& uv : primitive.uvs) {
            add(uv.u);
            add(uv.v);
        }
        if (material.image >= 0) describeImage(material, surface);
    }

    void describeImage(const scene::Material& material, SurfaceWords& surface) {
        const scene::Image& image = scene_.images[static_cast<size_t>(material.image)];
        surface.how = static_cast<uint32_t>(material.wrapU) | static_cast<uint32_t>(material.wrapV) << 2;
        if (material.filter == image::Filter::nearest) surface.how |= 32;
        if (image.colour) {
            surface.colourAt = placeOnce(colours_, material.image, [&] { addColour(*image.colour); });
            surface.colourSize = packedSize(image.colour->width, image.colour->height);
        }
        if (surface.kind == 0 || !image.alpha) return;
        surface.alphaAt = placeOnce(alphas_, material.image, [&] { addAlpha(*image.alpha); });
        surface.alphaSize = packedSize(image.alpha->width, image.alpha->height);
        if (image.alpha->steps == 255) surface.how |= 16;
    }

    template <class Write>
    uint32_t placeOnce(std::map<int, uint32_t>& places, int image, const Write& write) {
        const auto [found, isNew] = places.emplace(image, here());
        if (isNew) write();
        return found->second;
    }

    void addColour(const scene::ColourImage& image) {
        const size_t first = made_.words.size();
        made_.words.resize(first + image.rgba.size() / 4);
        std::memcpy(made_.words.data() + first, image.rgba.data(), image.rgba.size());
    }

    void addAlpha(const image::AlphaImage& image) {
        if (image.steps != 255) {
            for (const uint16_t texel : image.texels) add(static_cast<float>(texel / 65535.0));
            return;
        }
        const size_t first = made_.words.size();
        made_.words.resize(first + (image.texels.size() + 3) / 4);
        for (size_t k = 0; k < image.texels.size(); ++k)
            made_.words[first + k / 4] |= uint32_t{image.texels[k]} / 257 << (8 * (k % 4));
    }

    const scene::Scene& scene_;
    bool opaque_;
    SceneWords made_;
    uint32_t tablesAt_ = 0;
    std::map<int, uint32_t> alphas_;   // by image, where its alphas begin
    std::map<int, uint32_t> colours_;  // by image, where its colours begin
};

}  // namespace

Result<SceneWords> sceneWords(const scene::Scene& scene, bool opaque) {
    return SceneWriter(scene, opaque).run();
}

}  // namespace filigree::vulkan
