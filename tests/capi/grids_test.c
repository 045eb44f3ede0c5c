// Vertex grids and rays from C.
#include "check.h"
#include "samples.h"
#include "suites.h"

#include <math.h>
#include <string.h>

enum { hillTriangles = 2 * (hillSide - 1) * (hillSide - 1), rays = 1500 };

// Rays from above onto places all over the hills, the last beside them.
static void aim(filigree_ray* list) {
    for (int k = 0; k < rays; ++k) {
        const filigree_ray ray = {
            {(float)(k % 40) / 2 + 0.1F, 50, (float)(k / 40) / 2 + 0.1F}, {0.01F, -2, 0.02F}, 0, 1000};
        list[k] = ray;
    }
    list[rays - 1].origin[0] = -5;
}

// The hit's place on the decoded triangle is where the ray says.
static void checkHit(const filigree_ray* ray, const filigree_hit* hit,
                     const filigree_grid_triangle* triangles) {
    const filigree_grid_triangle* triangle =
        &triangles[2 * (hit->row * (hillSide - 1) + hit->column) + hit->half];
    CHECK(triangle->source == hit->source);
    for (int axis = 0; axis < 3; ++axis) {
        const float onTriangle = triangle->positions[0][axis] * (1 - hit->u - hit->v) +
                                 triangle->positions[1][axis] * hit->u +
                                 triangle->positions[2][axis] * hit->v;
        CHECK(fabsf(onTriangle - (ray->origin[axis] + hit->t * ray->direction[axis])) < 1e-3F);
    }
}

static void checkRays(const filigree_grids* grids) {
    static filigree_ray list[rays];
    static filigree_hit hits[rays];
    static uint8_t answers[rays];
    static filigree_grid_triangle triangles[hillTriangles];
    // Rays and hits within a caller's own structs.
    static struct {
        uint32_t pixel;
        filigree_ray ray;
        filigree_hit hit;
    } wide[rays];
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_tracer* tracer = NULL;
    size_t count = 0;
    aim(list);
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_grids_get_triangles(grids, triangles, hillTriangles, &count, &error));
    CHECK(count == hillTriangles && triangles[5].source == 5);
    CHECK_CODE(FILIGREE_OK, &error, filigree_tracer_create(NULL, grids, &tracer, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_tracer_closest(tracer, rays, list, 0, hits, 0, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_tracer_any(tracer, rays, list, 0, answers, &error));
    for (int k = 0; k + 1 < rays; ++k) {
        CHECK(answers[k] == 1 && hits[k].grid == 0);
        if (hits[k].grid == 0) checkHit(&list[k], &hits[k], triangles);
    }
    CHECK(answers[rays - 1] == 0 && hits[rays - 1].grid == FILIGREE_NO_GRID && isinf(hits[rays - 1].t));
    for (int k = 0; k < rays; ++k) wide[k].ray = list[k];
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_tracer_closest(tracer, rays, &wide[0].ray, sizeof wide[0], &wide[0].hit,
                                       sizeof wide[0], &error));
    for (int k = 0; k < rays; ++k) CHECK(memcmp(&wide[k].hit, &hits[k], sizeof hits[k]) == 0);

    // Rays that are none hit nothing.
    list[0].direction[0] = list[0].direction[1] = list[0].direction[2] = 0;
    list[1].origin[1] = NAN;
    list[2].t_min = 2000;
    CHECK_CODE(FILIGREE_OK, &error, filigree_tracer_any(tracer, rays, list, 0, answers, &error));
    CHECK(answers[0] == 0 && answers[1] == 0 && answers[2] == 0 && answers[3] == 1);

    filigree_surface surface = FILIGREE_SURFACE_INIT;
    CHECK_CODE(FILIGREE_OK, &error, filigree_grids_get_surface(grids, &hits[20], &surface, &error));
    CHECK(fabsf(surface.grid_u - (float)hits[20].column / (hillSide - 1)) <= 1.0F / (hillSide - 1));
    CHECK(surface.has_normal == 0 && surface.has_uv == 0);
    hits[20].column = hillSide - 1;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error,
               filigree_grids_get_surface(grids, &hits[20], &surface, &error));
    hits[20].grid = FILIGREE_NO_GRID;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error,
               filigree_grids_get_surface(grids, &hits[20], &surface, &error));

    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error, filigree_tracer_any(tracer, 1, NULL, 0, answers, &error));
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error, filigree_tracer_any(tracer, 2, list, 16, answers, &error));
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error, filigree_tracer_any(tracer, 2, list, 34, answers, &error));
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error,
               filigree_tracer_any(tracer, 2, list, 0, (uint8_t*)&list[1], &error));
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error, filigree_tracer_any(NULL, 1, list, 0, answers, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_tracer_any(tracer, 0, NULL, 0, NULL, &error));
    filigree_tracer_destroy(tracer);
}

static void checkHills(void) {
    const filigree_heightfield heights = hillHeights();
    filigree_grids* grids = gridsOfHills(NULL);
    filigree_grids* lossless = NULL;
    filigree_grid_settings settings = FILIGREE_GRID_SETTINGS_INIT;
    filigree_grids_info info = FILIGREE_GRIDS_INFO_INIT;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    CHECK_CODE(FILIGREE_OK, &error, filigree_grids_get_info(grids, &info, &error));
    CHECK(info.grid_count == 1 && info.triangle_count == hillTriangles && info.loose_count == 0);
    CHECK(info.geometry_bytes > 0 && info.hierarchy_bytes > 0 && info.rms_error >= 0);
    checkRays(grids);
    filigree_grids_destroy(grids);

    settings.precision = FILIGREE_GRID_LOSSLESS;
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_grids_create_from_heights(NULL, &heights, &settings, NULL, &lossless, &error));
    filigree_grids_get_info(lossless, &info, NULL);
    CHECK(info.max_error == 0 && info.rms_error == 0);
    filigree_grids_destroy(lossless);

    settings.precision = FILIGREE_GRID_MAX_ERROR;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error,
               filigree_grids_create_from_heights(NULL, &heights, &settings, NULL, &lossless, &error));
    settings.max_error = 0.01;
    settings.measure = 0;
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_grids_create_from_heights(NULL, &heights, &settings, NULL, &lossless, &error));
    filigree_grids_get_info(lossless, &info, NULL);
    CHECK(info.max_error == -1);
    filigree_grids_destroy(lossless);

    settings.codec = FILIGREE_GRID_PAPER;
    settings.snap = 1;
    settings.measure = 1;
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_grids_create_from_heights(NULL, &heights, &settings, NULL, &lossless, &error));
    filigree_grids_get_info(lossless, &info, NULL);
    CHECK(info.codec == FILIGREE_GRID_PAPER && info.max_error > 0);
    filigree_grids_destroy(lossless);
}

// A card of quads with a triangle beside it, normals and texture coordinates.
static void checkMesh(void) {
    enum { side = 9 };
    float positions[side * side + 3][3], normals[side * side + 3][3], uvs[side * side + 3][2];
    uint32_t indices[(side - 1) * (side - 1) + 1][4];
    filigree_mesh mesh = FILIGREE_MESH_INIT;
    filigree_grids_info info = FILIGREE_GRIDS_INFO_INIT;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_surface surface = FILIGREE_SURFACE_INIT;
    filigree_grids* grids = NULL;
    filigree_tracer* tracer = NULL;
    filigree_hit hits[2];
    const filigree_ray list[2] = {{{2.25F, 3.5F, 10}, {0, 0, -1}, 0, 100},
                                  {{100.1F, 0.1F, 10}, {0, 0, -1}, 0, 100}};
    for (int k = 0; k < side * side + 3; ++k) {
        const float x = (float)(k % side), y = (float)(k / side);
        const float position[3] = {x, y, 0.01F * x * y}, normal[3] = {0, 0, 2}, uv[2] = {x / 8, y / 8};
        memcpy(positions[k], position, sizeof position);
        memcpy(normals[k], normal, sizeof normal);
        memcpy(uvs[k], uv, sizeof uv);
    }
    for (int k = 0; k < 3; ++k) {
        const float position[3] = {100 + (float)(k == 1), (float)(k == 2), 0};
        memcpy(positions[side * side + k], position, sizeof position);
    }
    for (uint32_t q = 0; q < (side - 1) * (side - 1); ++q) {
        const uint32_t at = q / (side - 1) * side + q % (side - 1);
        const uint32_t quad[4] = {at, at + 1, at + side + 1, at + side};
        memcpy(indices[q], quad, sizeof quad);
    }
    const uint32_t loose[4] = {side * side, side * side + 1, side * side + 2, 0xffffffffu};
    memcpy(indices[(side - 1) * (side - 1)], loose, sizeof loose);
    mesh.positions = positions[0];
    mesh.normals = normals[0];
    mesh.uvs = uvs[0];
    mesh.vertex_count = side * side + 3;
    mesh.indices = indices;
    mesh.index_bytes = 4;
    mesh.face_vertices = 4;
    mesh.face_count = (side - 1) * (side - 1) + 1;
    CHECK_CODE(FILIGREE_OK, &error, filigree_grids_create(NULL, &mesh, NULL, NULL, &grids, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_grids_get_info(grids, &info, &error));
    CHECK(info.grid_count == 1 && info.loose_count == 1 && info.triangle_count == 2 * 64 + 1);
    CHECK(info.attribute_bytes > 0);
    CHECK_CODE(FILIGREE_OK, &error, filigree_tracer_create(NULL, grids, &tracer, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_tracer_closest(tracer, 2, list, 0, hits, 0, &error));
    CHECK(hits[0].grid == 0 && hits[0].source / 2 == 3 * (side - 1) + 2);
    CHECK(hits[1].grid == FILIGREE_LOOSE_GRID && hits[1].source == 2 * 64);
    CHECK_CODE(FILIGREE_OK, &error, filigree_grids_get_surface(grids, &hits[0], &surface, &error));
    CHECK(surface.has_normal == 1 && fabsf(surface.normal[2] - 2) < 1e-5F);
    CHECK(surface.has_uv == 1 && fabsf(surface.uv[0] - 2.25F / 8) < 1e-3F);
    CHECK_CODE(FILIGREE_OK, &error, filigree_grids_get_surface(grids, &hits[1], &surface, &error));
    filigree_tracer_destroy(tracer);
    filigree_grids_destroy(grids);

    indices[5][2] = side * side + 3;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error,
               filigree_grids_create(NULL, &mesh, NULL, NULL, &grids, &error));
    indices[5][2] = 0;
    positions[7][1] = INFINITY;
    CHECK_CODE(FILIGREE_ERROR_FORMAT, &error, filigree_grids_create(NULL, &mesh, NULL, NULL, &grids, &error));
    CHECK(grids == NULL);
}

int gridsSuite(void) {
    failedChecks = 0;
    checkHills();
    checkMesh();
    return failedChecks;
}
