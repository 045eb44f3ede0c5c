#include "jobs/atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr double mostRepeats = 2;  // of a triangle, on each axis

// Texels of an image, unwrapped, both ends included.
struct Span {
    int64_t low = 0;
    int64_t high = -1;
    [[nodiscard]] bool empty() const { return high < low; }
    [[nodiscard]] uint32_t size() const { return static_cast<uint32_t>(high - low + 1); }
    void add(const Span& other) {
        *this = empty() ? other : Span{std::min(low, other.low), std::max(high, other.high)};
    }
};

// What part of an image its triangles use, and where that goes.
struct Window {
    int image = -1;
    std::array<image::Wrap, 2> wraps{};
    Span columns;
    Span rows;
    std::optional<std::array<uint32_t, 2>> place;  // of its lowest texel in the atlas
};

// How one axis of a triangle moves.
struct AxisMove {
    double shift = 0;  // whole repeats, taken off the coordinate
    Span texels;       // that filtering may read then, with one more on each side
};

// None where the triangle goes over too many repeats.
std::optional<AxisMove> moveOf(const std::array<float, 3>& coordinates, uint32_t size, image::Wrap wrap) {
    const auto [least, most] = std::ranges::minmax(coordinates);
    if (!(std::abs(least) < 1e6F && std::abs(most) < 1e6F) || most - least > mostRepeats) return std::nullopt;
    AxisMove move;
    if (wrap == image::Wrap::repeat) move.shift = std::floor(double{least});
    if (wrap == image::Wrap::mirroredRepeat) move.shift = 2 * std::floor(double{least} / 2);
    move.texels.low = static_cast<int64_t>(std::floor((least - move.shift) * size - 0.5)) - 1;
    move.texels.high = static_cast<int64_t>(std::floor((most - move.shift) * size - 0.5)) + 2;
    return move;
}

class Packer {
  public:
    Packer(scene::Scene& scene, uint32_t side) : scene_(scene), side_(side) {}

    std::vector<std::string> run() {
        forEachPrimitive([&](scene::Primitive& primitive) { widenWindow(primitive); });
        placeWindows();
        drawAtlas();
        for (auto& mesh : scene_.meshes) movePrimitives(mesh);
        noteCounts();
        return std::move(notes_);
    }

  private:
    using Moves = std::array<AxisMove, 2>;
    using WindowKey = std::tuple<int, image::Wrap, image::Wrap>;

    template <class Visit>
    void forEachPrimitive(Visit&& visit) {
        for (auto& mesh : scene_.meshes) {
            for (auto& primitive : mesh.primitives) visit(primitive);
        }
    }

    // The material, where the atlas may take its image.
    [[nodiscard]] const scene::Material* materialOf(const scene::Primitive& primitive) const {
        if (primitive.material < 0 || primitive.uvs.empty()) return nullptr;
        const scene::Material& material = scene_.materials[static_cast<size_t>(primitive.material)];
        if (material.alphaMode == scene::AlphaMode::opaque || material.image < 0) return nullptr;
        const scene::Image& image = scene_.images[static_cast<size_t>(material.image)];
        return image.alpha && image.colour && image.alpha->steps == 255 ? &material : nullptr;
    }
    [[nodiscard]] const image::AlphaImage& alphaOf(const scene::Material& material) const {
        return *scene_.images[static_cast<size_t>(material.image)].alpha;
    }
    Window& windowOf(const scene::Material& material) {
        Window& window = windows_[{material.image, material.wrapU, material.wrapV}];
        window.image = material.image;
        window.wraps = {material.wrapU, material.wrapV};
        return window;
    }

    [[nodiscard]] std::optional<Moves> movesOf(const scene::Primitive& primitive, size_t triangle,
                                               const scene::Material& material) const {
        const mesh::UvTriangle t = primitive.uvTriangle(triangle);
        const image::AlphaImage& alpha = alphaOf(material);
        const auto u = moveOf({t.uv[0].u, t.uv[1].u, t.uv[2].u}, alpha.width, material.wrapU);
        const auto v = moveOf({t.uv[0].v, t.uv[1].v, t.uv[2].v}, alpha.height, material.wrapV);
        if (!u || !v) return std::nullopt;
        return Moves{*u, *v};
    }

    void widenWindow(const scene::Primitive& primitive) {
        const scene::Material* material = materialOf(primitive);
        if (material == nullptr) return;
        Window& window = windowOf(*material);
        for (size_t t = 0; t < primitive.triangleCount(); ++t) {
            const auto moves = movesOf(primitive, t, *material);
            if (!moves) continue;
            window.columns.add((*moves)[0].texels);
            window.rows.add((*moves)[1].texels);
        }
    }

    // Highest first, on shelves.
    void placeWindows() {
        std::vector<Window*> order;
        for (auto& [key, window] : windows_) {
            if (!window.columns.empty()) order.push_back(&window);
        }
        std::ranges::stable_sort(order, [](const Window* a, const Window* b) {
            return std::pair(a->rows.size(), a->columns.size()) >
                   std::pair(b->rows.size(), b->columns.size());
        });
        struct Shelf {
            uint32_t bottom;
            uint32_t height;
            uint32_t used;
        };
        std::vector<Shelf> shelves;
        uint32_t top = 0;
        for (Window* window : order) {
            const uint32_t width = window->columns.size();
            const uint32_t height = window->rows.size();
            auto shelf = std::ranges::find_if(shelves, [&](const Shelf& s) {
                return s.height >= height && width <= side_ && s.used <= side_ - width;
            });
            if (shelf == shelves.end()) {
                if (width > side_ || height > side_ - top) {
                    notes_.push_back(fmt::format("{}: {} x {} texels find no place in the atlas",
                                                 name(*window), width, height));
                    continue;
                }
                shelf = shelves.insert(shelf, {top, height, 0});
                top += height;
            }
            window->place = {shelf->used, shelf->bottom};
            shelf->used += width;
        }
    }

    [[nodiscard]] const std::string& name(const Window& window) const {
        return scene_.images[static_cast<size_t>(window.image)].name;
    }

    void drawAtlas() {
        const size_t texels = size_t{side_} * side_;
        scene::Image atlas;
        atlas.name = "atlas";
        atlas.alpha = image::AlphaImage{side_, side_, std::vector<uint16_t>(texels), 255};
        atlas.colour = scene::ColourImage{side_, side_, std::vector<uint8_t>(4 * texels)};
        for (const auto& [key, window] : windows_) {
            if (window.place) draw(window, atlas);
        }
        scene_.images.push_back(std::move(atlas));
    }

    void draw(const Window& window, scene::Image& atlas) {
        const scene::Image& from = scene_.images[static_cast<size_t>(window.image)];
        for (uint32_t row = 0; row < window.rows.size(); ++row) {
            const uint32_t y = image::wrapTexel(window.rows.low + row, from.alpha->height, window.wraps[1]);
            for (uint32_t column = 0; column < window.columns.size(); ++column) {
                const uint32_t x =
                    image::wrapTexel(window.columns.low + column, from.alpha->width, window.wraps[0]);
                const size_t to = size_t{(*window.place)[1] + row} * side_ + (*window.place)[0] + column;
                const auto* rgba = &from.colour->rgba[4 * (size_t{y} * from.alpha->width + x)];
                std::copy(rgba, rgba + 3, &atlas.colour->rgba[4 * to]);
                atlas.colour->rgba[4 * to + 3] = static_cast<uint8_t>(from.alpha->at(x, y) / 257);
                atlas.alpha->texels[to] = from.alpha->at(x, y);
            }
        }
        filled_ += uint64_t{window.rows.size()} * window.columns.size();
    }

    // A copy of the material that reads the atlas.
    int materialInAtlas(int number) {
        const auto [at, isNew] = materials_.try_emplace(number, static_cast<int>(scene_.materials.size()));
        if (isNew) {
            scene::Material material = scene_.materials[static_cast<size_t>(number)];
            material.image = static_cast<int>(scene_.images.size()) - 1;
            material.wrapU = material.wrapV = image::Wrap::clampToEdge;
            scene_.materials.push_back(std::move(material));
        }
        return at->second;
    }

    void movePrimitives(scene::Mesh& mesh) {
        std::vector<scene::Primitive> primitives;
        for (scene::Primitive& primitive : mesh.primitives) {
            scene::Primitive moved = takeMoved(primitive);
            if (moved.triangleCount() > 0) primitives.push_back(std::move(moved));
            if (primitive.triangleCount() > 0) primitives.push_back(std::move(primitive));
        }
        mesh.primitives = std::move(primitives);
    }

    // The triangles that go to the atlas; the others stay in `primitive`.
    scene::Primitive takeMoved(scene::Primitive& primitive) {
        scene::Primitive moved;
        const scene::Material* material = materialOf(primitive);
        if (material == nullptr) return moved;
        const Window window = windowOf(*material);
        const image::AlphaImage& alpha = alphaOf(*material);
        const std::array sizes{alpha.width, alpha.height};
        std::vector<uint32_t> left;
        std::map<std::tuple<uint32_t, double, double>, uint32_t> vertices;
        for (size_t t = 0; t < primitive.triangleCount(); ++t) {
            const auto moves = movesOf(primitive, t, *material);
            const auto corners = std::span(primitive.indices).subspan(3 * t, 3);
            if (!window.place || !moves) {
                left.insert(left.end(), corners.begin(), corners.end());
                continue;
            }
            for (const uint32_t vertex : corners) {
                const auto [at, isNew] = vertices.try_emplace({vertex, (*moves)[0].shift, (*moves)[1].shift},
                                                              static_cast<uint32_t>(moved.positions.size()));
                if (isNew) addVertex(primitive, vertex, window, *moves, sizes, moved);
                moved.indices.push_back(at->second);
            }
        }
        moved.meshIndex = primitive.meshIndex;
        moved.primitiveIndex = primitive.primitiveIndex;
        moved_ += moved.triangleCount();
        left_ += left.size() / 3;
        if (moved.triangleCount() > 0) moved.material = materialInAtlas(primitive.material);
        primitive.indices = std::move(left);
        return moved;
    }

    void addVertex(const scene::Primitive& from, uint32_t vertex, const Window& window, const Moves& moves,
                   const std::array<uint32_t, 2>& sizes, scene::Primitive& to) const {
        const auto placed = [&](float at, size_t axis, const Span& span) {
            const double texel = (at - moves[axis].shift) * sizes[axis] - static_cast<double>(span.low);
            return static_cast<float>((texel + (*window.place)[axis]) / side_);
        };
        const mesh::Uv& uv = from.uvs[vertex];
        to.positions.push_back(from.positions[vertex]);
        to.uvs.push_back({placed(uv.u, 0, window.columns), placed(uv.v, 1, window.rows)});
        if (!from.alphas.empty()) to.alphas.push_back(from.alphas[vertex]);
    }

    void noteCounts() {
        notes_.push_back(fmt::format(
            "atlas of {0} x {0} texels: {1:.1f} % filled, {2} triangles in it, {3} keep their own "
            "texture",
            side_, 100.0 * static_cast<double>(filled_) / (double{side_ * 1.0} * side_), moved_, left_));
    }

    scene::Scene& scene_;
    uint32_t side_;
    std::map<WindowKey, Window> windows_;
    std::map<int, int> materials_;  // to those that read the atlas
    uint64_t filled_ = 0;           // texels
    uint64_t moved_ = 0;            // triangles
    uint64_t left_ = 0;
    std::vector<std::string> notes_;
};

}  // namespace

Result<std::vector<std::string>> packAtlas(scene::Scene& scene, uint32_t side) {
    if (side == 0 || side > image::maxImageSide) {
        return Error{ErrorKind::usage,
                     fmt::format("--atlas {}: give 1 to {} texels", side, image::maxImageSide)};
    }
    return Packer(scene, side).run();
}

}  // namespace filigree::jobs
