#include "jobs/texture_group.h"

#include "filigree/micromap/quadtree.h"

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

const scene::Material* materialOf(const scene::Scene& scene, const scene::Primitive& primitive) {
    return primitive.material < 0 ? nullptr : &scene.materials[static_cast<size_t>(primitive.material)];
}

bool hasAlpha(const scene::Scene& scene, const scene::Primitive& primitive) {
    const scene::Material* material = materialOf(scene, primitive);
    if (material == nullptr || material->alphaMode == scene::AlphaMode::opaque) return false;
    return material->image < 0 || scene.images[static_cast<size_t>(material->image)].alpha.has_value();
}

// A micromap in use: by how many triangles, and what it holds.
struct Use {
    uint64_t triangles = 0;
    micromap::Record record;
    micromap::StateCounts states;
};

Use useOf(const micromap::FlatSet& set, int32_t index) {
    const micromap::Record& record = set.records[static_cast<size_t>(index)];
    const auto flat =
        std::span(set.data).subspan(record.byteOffset, micromap::flatBytes(record.level, record.format));
    const auto tree = micromap::quadtreeFromFlat(flat, record.level, record.format);
    return {0, record, micromap::countStates(tree.view())};
}

// In texels; 0 for triangles that are not finite.
double areaOf(const mesh::UvTriangle& t, const InspectedTexture& texture) {
    const double ax = (double{t.uv[1].u} - t.uv[0].u) * texture.width;
    const double ay = (double{t.uv[1].v} - t.uv[0].v) * texture.height;
    const double bx = (double{t.uv[2].u} - t.uv[0].u) * texture.width;
    const double by = (double{t.uv[2].v} - t.uv[0].v) * texture.height;
    const double area = std::abs(ax * by - ay * bx) / 2;
    return std::isfinite(area) ? area : 0;
}

class Measurer {
  public:
    Measurer(const scene::Scene& scene, InspectedTexture& texture) : scene_(scene), texture_(texture) {}

    void add(const scene::Primitive& primitive) {
        for (size_t t = 0; t < primitive.triangleCount(); ++t) {
            const double area = areaOf(primitive.uvTriangle(t), texture_);
            const int32_t index = primitive.micromapIndices[t];
            ++texture_.triangles;
            if (index < 0) {
                addSpecial(static_cast<size_t>(micromap::stateOfSpecialIndex(index)), area);
            } else {
                addRecord(primitive.micromaps, index, area);
            }
        }
    }

    void finish() {
        texture_.micromaps = uses_.size();
        for (const auto& [key, use] : uses_) {
            ++texture_.levels[use.record.level];
            ++texture_.sharing[use.triangles];
            texture_.bytes +=
                micromap::flatBytes(use.record.level, use.record.format) + micromap::recordBytes;
        }
    }

  private:
    void addSpecial(size_t state, double area) {
        ++texture_.special[state];
        ++texture_.states[state];
        texture_.area[state] += area;
    }

    void addRecord(int micromaps, int32_t index, double area) {
        const auto [place, isNew] = uses_.try_emplace({micromaps, index});
        Use& use = place->second;
        if (isNew) use = useOf(scene_.micromaps[static_cast<size_t>(micromaps)].set, index);
        ++use.triangles;
        const auto total = static_cast<double>(use.states.total());
        for (size_t s = 0; s < 4; ++s) {
            texture_.states[s] += use.states.of[s];
            texture_.area[s] += area * (static_cast<double>(use.states.of[s]) / total);
        }
    }

    const scene::Scene& scene_;
    InspectedTexture& texture_;
    std::map<std::pair<int, int32_t>, Use> uses_;
};

}  // namespace

std::array<double, 4> InspectedTexture::areaShares() const {
    const double total = std::accumulate(area.begin(), area.end(), 0.0);
    std::array<double, 4> shares{};
    for (size_t s = 0; s < 4 && total > 0; ++s) shares[s] = area[s] / total;
    return shares;
}

std::vector<TextureGroup> textureGroups(const scene::Scene& scene, std::vector<std::string>& notes) {
    std::vector<TextureGroup> groups;
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) {
            if (primitive.micromaps < 0 || primitive.triangleCount() == 0) continue;
            if (!hasAlpha(scene, primitive)) {
                notes.push_back(
                    fmt::format("/meshes/{}/primitives/{}: has micromaps but no alpha to draw them over",
                                primitive.meshIndex, primitive.primitiveIndex));
                continue;
            }
            addToGroup(groups, sourceOf(*materialOf(scene, primitive)), primitive);
        }
    }
    return groups;
}

InspectedTexture measure(const scene::Scene& scene, const TextureGroup& group) {
    InspectedTexture texture;
    const int image = group.source.image;
    texture.width = image < 0 ? 1 : scene.images[static_cast<size_t>(image)].alpha->width;
    texture.height = image < 0 ? 1 : scene.images[static_cast<size_t>(image)].alpha->height;
    Measurer measurer(scene, texture);
    for (const auto* primitive : group.primitives) measurer.add(*primitive);
    measurer.finish();
    return texture;
}

std::vector<OverlayTriangle> overlayTriangles(const scene::Scene& scene, const TextureGroup& group) {
    std::vector<OverlayTriangle> triangles;
    for (const auto& place : distinctTriangles(group.primitives)) {
        const auto& micromaps = scene.micromaps[static_cast<size_t>(place.primitive->micromaps)];
        triangles.push_back({place.uvTriangle().uv, &micromaps.set, place.micromapIndex()});
    }
    return triangles;
}

}  // namespace filigree::jobs
