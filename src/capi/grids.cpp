#include "capi/grids.h"

#include "filigree/grid/convert.h"
#include "filigree/grid/decode_grids.h"
#include "filigree/grid/encode_grids.h"
#include "filigree/grid/error.h"
#include "filigree/grid/lattice_choice.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/context.h"
#include "capi/mesh.h"
#include "capi/progress.h"

#include <cmath>

namespace filigree::capi {
namespace {

using grid::Codec;

constexpr filigree_grid_settings gridDefaults = FILIGREE_GRID_SETTINGS_INIT;

struct GridSettings {
    Codec codec = Codec::lattice;
    filigree_grid_precision precision = FILIGREE_GRID_MATCH_PAPER;
    double maxError = 0;
    grid::DisplacementCode displacement = grid::DisplacementCode::unitVector;
    bool snap = false;
    bool turnQuads = false;
    bool attributes = true;
    bool measure = true;
};

GridSettings settingsOf(const filigree_grid_settings* given) {
    const filigree_grid_settings from = taken(given, gridDefaults, "settings");
    GridSettings settings;
    settings.codec = enumerator(from.codec, Codec::lattice, "settings.codec");
    settings.precision = enumerator(from.precision, FILIGREE_GRID_LOSSLESS, "settings.precision");
    settings.maxError = from.max_error;
    if (flag(from.shared_exponent, "settings.shared_exponent"))
        settings.displacement = grid::DisplacementCode::sharedExponent;
    settings.snap = flag(from.snap, "settings.snap");
    settings.turnQuads = flag(from.turn_quads, "settings.turn_quads");
    settings.attributes = flag(from.attributes, "settings.attributes");
    settings.measure = flag(from.measure, "settings.measure");
    return settings;
}

Result<grid::Lattice> chooseLattice(const grid::GridMesh& mesh, const GridSettings& settings,
                                    const Executor& executor) {
    switch (settings.precision) {
        case FILIGREE_GRID_LOSSLESS:
            return grid::losslessLattice(mesh);
        case FILIGREE_GRID_MAX_ERROR:
            return grid::latticeForError(mesh, settings.maxError);
        case FILIGREE_GRID_MAX_ERROR_SHARE:
            return grid::latticeForError(mesh, settings.maxError * grid::boundsOf(mesh).diagonal());
        default:
            break;
    }
    auto matched = grid::latticeMatchingPaper(mesh, settings.displacement, executor);
    if (!matched) return matched.error();
    return matched->lattice;
}

grid::EncodeOptions encodeOptionsFor(const grid::GridMesh& mesh, const GridSettings& settings,
                                     const Executor& executor) {
    grid::EncodeOptions options;
    options.codec = settings.codec;
    options.displacement = settings.displacement;
    options.snap = settings.snap;
    if (settings.codec == Codec::lattice) options.lattice = orFail(chooseLattice(mesh, settings, executor));
    return options;
}

void measure(const grid::GridMesh& mesh, const Executor& executor, filigree_grids& grids) {
    const auto decoded = grid::decodeGrids(grids.file.grids, mesh.grids, grids.file.looseTriangles, executor);
    const grid::GridErrors errors = grid::errorsOf(mesh, decoded, executor);
    grids.rmsError = errors.all.rms;
    grids.maxError = errors.all.max;
}

Owned<filigree_grids> gridsFrom(grid::GridMesh mesh, const GridSettings& settings,
                                const filigree_context* context, ProgressSink& progress) {
    if (!(grid::boundsOf(mesh).diagonal() > 0))
        fail(FILIGREE_ERROR_FORMAT, "all vertices stand in one point");
    const Executor& executor = executorOf(context);
    auto grids = makeHandle<filigree_grids>(memoryOf(context));
    io::FilGrids& file = grids->file;
    const auto options = encodeOptionsFor(mesh, settings, executor);
    file.grids = orFail(grid::encodeGrids(mesh, options, executor, progress));
    if (progress.cancelled()) fail(FILIGREE_ERROR_CANCELLED, "the grids were cancelled");
    file.table = mesh.grids;
    file.looseTriangles = static_cast<uint32_t>(mesh.looseTriangles.size());
    if (settings.measure) measure(mesh, executor, *grids);
    file.attributes = grid::attributesOf(mesh);
    if (!settings.attributes) {
        grid::GridAttributes shape;  // which the triangles need
        shape.diagonals = std::move(file.attributes.diagonals);
        file.attributes = std::move(shape);
    }
    return grids;
}

filigree_grids_info infoOf(const filigree_grids& grids) {
    const io::FilGrids& file = grids.file;
    const grid::GridBytes bytes = grid::bytesOf(file.grids);
    filigree_grids_info info{};
    info.codec = static_cast<uint32_t>(file.grids.codec);
    info.grid_count = static_cast<uint32_t>(file.table.size());
    info.triangle_count = file.triangleCount();
    info.loose_count = file.looseTriangles;
    info.geometry_bytes = bytes.geometry;
    info.hierarchy_bytes = bytes.bvh;
    info.cluster_bytes = bytes.clusters;
    info.attribute_bytes = file.attributes.bytes();
    info.rms_error = grids.rmsError;
    info.max_error = grids.maxError;
    return info;
}

}  // namespace

uint32_t sourceOf(const filigree_grids& grids, const grid::Hit& hit) {
    const auto number = [&] { return static_cast<uint32_t>(2 * grids.file.quadCount() + hit.column); };
    const auto source = grid::sourceAt(grids.file.attributes, grids.file.table, hit);
    return source ? *source : number();
}

}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_grid_settings_init(filigree_grid_settings* settings, size_t struct_size) {
    return initialise(settings, struct_size, gridDefaults);
}

filigree_error filigree_grids_create(const filigree_context* context, const filigree_mesh* mesh,
                                     const filigree_grid_settings* settings,
                                     const filigree_progress* progress, filigree_grids** out,
                                     filigree_error_info* error) {
    return make(out, error, [&] {
        CallerProgress told(progress);
        const GridSettings chosen = settingsOf(settings);
        filigree::grid::ConvertOptions options;
        options.uniformDiagonals = chosen.codec == filigree::grid::Codec::paper;
        options.turnQuads = chosen.turnQuads;
        options.attributes = chosen.attributes;
        auto grids = orFail(filigree::grid::gridsOf(facesOf(mesh), options, executorOf(context)));
        if (told.sink().cancelled()) fail(FILIGREE_ERROR_CANCELLED, "the grids were cancelled");
        return gridsFrom(std::move(grids), chosen, context, told.sink()).release();
    });
}

filigree_error filigree_grids_create_from_heights(const filigree_context* context,
                                                  const filigree_heightfield* heights,
                                                  const filigree_grid_settings* settings,
                                                  const filigree_progress* progress, filigree_grids** out,
                                                  filigree_error_info* error) {
    return make(out, error, [&] {
        CallerProgress told(progress);
        return gridsFrom(gridOf(heights), settingsOf(settings), context, told.sink()).release();
    });
}

void filigree_grids_destroy(filigree_grids* grids) {
    destroy(grids);
}

filigree_error filigree_grids_get_info(const filigree_grids* grids, filigree_grids_info* info,
                                       filigree_error_info* error) {
    return call(error, [&] { give(infoOf(required(grids, "grids")), info, "info"); });
}
