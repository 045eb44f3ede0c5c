#include "jobs/grid_views.h"

#include "filigree/grid/error.h"
#include "filigree/trace/render.h"

#include "jobs/colour_ramp.h"
#include "jobs/opacity_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr unsigned viewSamples = 4;
constexpr uint32_t tileSide = 16;  // quads of a tile (grid/tile.h), at most
// The exposure at which a surface that faces the camera of Integrator::primary has the colour it was given.
constexpr float frontExposure = 1 / 1.8F;

using ColourOf = std::function<Colour(const grid::Hit&)>;

// A picture whose surfaces have colours by what a ray hits; without `colourOf` as render draws them.
class GridPainter {
  public:
    GridPainter(const GridViewSource& source, uint32_t width, uint32_t height, const Executor& executor,
                ProgressSink& progress)
        : source_(source), executor_(executor), progress_(progress) {
        settings_.width = width;
        settings_.height = height;
    }

    Result<scene::ColourImage> paint(const ColourOf& colourOf) {
        trace::WorldOptions building;
        building.grids.grids = &source_.grids;
        building.grids.table = source_.mesh.grids;
        building.grids.triangles = source_.mesh.triangleCount();
        building.grids.attributes = &source_.attributes;
        if (colourOf) {
            building.grids.albedo = [&](const grid::Hit& hit) {
                const Colour colour = colourOf(hit);
                return trace::albedoOfSrgb({colour.r, colour.g, colour.b});
            };
        }
        const scene::Scene none;
        const auto world = trace::World::build(none, building);
        if (!world) return world.error();
        const auto opacity = makeOpacity(trace::Method::none, 4, none, {}, *world, executor_);
        if (!opacity) return opacity.error();
        aim(*world);
        settings_.integrator = colourOf ? trace::Integrator::primary : trace::Integrator::shadow;
        trace::Film film(settings_.width, settings_.height);
        for (unsigned k = 0; k < viewSamples; ++k) {
            if (!addSample(*world, *opacity->opacity, settings_, executor_, progress_, film))
                return Error{ErrorKind::cancelled, "stopped while rendering"};
        }
        return colourOf ? exposed(film, frontExposure) : developed(film);
    }

  private:
    // All pictures have one view.
    void aim(const trace::World& world) {
        if (std::exchange(isAimed_, true)) return;
        const float aspect = static_cast<float>(settings_.width) / static_cast<float>(settings_.height);
        settings_.camera = trace::overview(world, aspect);
    }

    const GridViewSource& source_;
    const Executor& executor_;
    ProgressSink& progress_;
    trace::RenderSettings settings_;
    bool isAimed_ = false;
};

// ---- pieces ----

constexpr Colour looseColour{150, 150, 150};

// Of hues a golden section apart, so that neighbours differ.
Colour pieceColour(uint32_t piece, bool isDark) {
    constexpr double golden = 0.618033988749895;
    const double hue = 6 * (piece * golden - std::floor(piece * golden));
    std::array<double, 3> rgb{};
    for (size_t k = 0; k < 3; ++k) {
        const double at = std::fmod(hue + 4.0 - 2.0 * static_cast<double>(k) + 2.0, 6.0);
        rgb[k] = std::clamp(std::fabs(at - 3) - 1, 0.0, 1.0);
    }
    const double light = isDark ? 0.66 : 0.92;
    const auto channel = [&](size_t k) {
        return static_cast<uint8_t>(std::lround(255 * light * (0.45 + 0.55 * rgb[k])));
    };
    return {channel(0), channel(1), channel(2)};
}

// ---- errors ----

// The errors of all sub-grids, as table 3 of the paper has them, and of each loose triangle against its box.
struct SurfaceErrors {
    std::vector<grid::SubGridShares> grids;
    std::vector<float> loose;

    [[nodiscard]] double at(const grid::Hit& hit) const {
        if (hit.grid == grid::looseGrid) return loose[hit.column];
        const grid::SubGridShares& shares = grids[hit.grid];
        constexpr uint32_t quads = grid::paperQuads;
        return shares.shares[size_t{hit.row / quads} * shares.columns + hit.column / quads];
    }
};

float looseShare(const grid::GridMesh& mesh, const grid::DecodedGrids& decoded, size_t triangle) {
    Box box;
    double most = 0;
    for (size_t corner = 0; corner < 3; ++corner) {
        const Vec3& vertex = mesh.looseVertices[mesh.looseTriangles[triangle][corner]];
        const Vec3 off = minus(decoded.looseTriangles[triangle][corner], vertex);
        box.extend(vertex);
        most = std::max(most, std::sqrt(double{dot(off, off)}));
    }
    const double diagonal = box.diagonal();
    return diagonal > 0 ? static_cast<float>(most / diagonal) : 0.0F;
}

SurfaceErrors surfaceErrors(const GridViewSource& source) {
    SurfaceErrors errors;
    for (uint32_t k = 0; k < source.mesh.grids.size(); ++k)
        errors.grids.push_back(grid::subGridShares(source.mesh, source.decoded, k));
    for (size_t k = 0; k < source.mesh.looseTriangles.size(); ++k)
        errors.loose.push_back(looseShare(source.mesh, source.decoded, k));
    return errors;
}

// All but a thousandth of the sub-grids are below; without any, of the loose triangles.
double errorEnd(const SurfaceErrors& errors) {
    std::vector<float> all;
    for (const auto& piece : errors.grids) all.insert(all.end(), piece.shares.begin(), piece.shares.end());
    if (all.empty()) all = errors.loose;
    if (all.empty()) return 1;
    const auto at = all.begin() + static_cast<std::ptrdiff_t>((all.size() - 1) * 999 / 1000);
    std::nth_element(all.begin(), at, all.end());
    return rampEnd(*at > 0 ? *at : *std::ranges::max_element(all));
}

}  // namespace

Result<GridViews> drawGridViews(const GridViewSource& source, uint32_t width, uint32_t height,
                                const Executor& executor, ProgressSink& progress) {
    progress.begin("pictures", uint64_t{3} * viewSamples * width * height, "pixels");
    GridPainter painter(source, width, height, executor, progress);
    GridViews views;
    auto lit = painter.paint({});
    if (!lit) return lit.error();
    views.lit = std::move(*lit);

    const uint32_t quads = source.grids.codec == grid::Codec::paper ? grid::paperQuads : tileSide;
    auto pieces = painter.paint([&](const grid::Hit& hit) {
        if (hit.grid == grid::looseGrid) return looseColour;
        return pieceColour(hit.grid, ((hit.column / quads + hit.row / quads) & 1) != 0);
    });
    if (!pieces) return pieces.error();
    views.pieces = std::move(*pieces);

    const SurfaceErrors errors = surfaceErrors(source);
    const double end = errorEnd(errors);
    views.scale = rampScale(surfaceRamp(), "error, % of the sub-grid's diagonal", 100 * end, "");
    auto coloured = painter.paint(
        [&](const grid::Hit& hit) { return report::colourAt(views.scale, rampPlace(errors.at(hit), end)); });
    if (!coloured) return coloured.error();
    views.error = std::move(*coloured);
    progress.end();
    return views;
}

}  // namespace filigree::jobs
