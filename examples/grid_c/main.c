// Hills as a compressed grid, and rays that look for them, from C: every ray must meet the hill where it
// stands, within the error that was asked for.
#include <filigree.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { side = 129, view = 32 };
static const double maxError = 0.001;

static float heightAt(float x, float z) {
    return 0.5f * sinf(6 * x) * cosf(5 * z) + 0.1f * sinf(31 * x + 17 * z);
}

// Exits where something failed, and says what.
static void expect(filigree_error code, const filigree_error_info* error) {
    if (code == FILIGREE_OK) return;
    fprintf(stderr, "%s\n", error->message);
    exit(1);
}

static filigree_grids* makeHills(filigree_error_info* error) {
    static float heights[side * side];
    filigree_heightfield field = FILIGREE_HEIGHTFIELD_INIT;
    filigree_grid_settings settings = FILIGREE_GRID_SETTINGS_INIT;
    filigree_grids* grids = NULL;
    int k;
    for (k = 0; k < side * side; ++k)
        heights[k] = heightAt((float)(k % side) / (side - 1), (float)(k / side) / (side - 1));
    field.heights = heights;
    field.columns = side;
    field.rows = side;
    field.type = FILIGREE_TEXEL_F32;
    field.cell = 1.0 / (side - 1);
    settings.precision = FILIGREE_GRID_MAX_ERROR;
    settings.max_error = maxError;
    expect(filigree_grids_create_from_heights(NULL, &field, &settings, NULL, &grids, error), error);
    return grids;
}

// Rays straight down, one for each character of the picture.
static void aim(filigree_ray* rays) {
    int k;
    for (k = 0; k < view * view; ++k) {
        const filigree_ray ray = {{((float)(k % view) + 0.5f) / view, 10, ((float)(k / view) + 0.5f) / view},
                                  {0, -1, 0},
                                  0,
                                  INFINITY};
        rays[k] = ray;
    }
}

int main(void) {
    static filigree_ray rays[view * view];
    static filigree_hit hits[view * view];
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_grids* grids = makeHills(&error);
    filigree_tracer* tracer = NULL;
    int wrong = 0;
    int k;
    aim(rays);
    expect(filigree_tracer_create(NULL, grids, &tracer, &error), &error);
    expect(filigree_tracer_closest(tracer, view * view, rays, 0, hits, 0, &error), &error);
    for (k = 0; k < view * view; ++k) {
        static const char shades[] = " .:-=+*#%@";
        const float height = rays[k].origin[1] - hits[k].t;
        // Between vertices the surface is flat: that may add as much as the curve of the hill.
        if (!(fabsf(height - heightAt(rays[k].origin[0], rays[k].origin[2])) < 0.01f)) ++wrong;
        putchar(shades[(int)fminf(9, fmaxf(0, 8.3f * (height + 0.6f)))]);
        if (k % view == view - 1) putchar('\n');
    }
    filigree_tracer_destroy(tracer);
    filigree_grids_destroy(grids);
    printf("%d of %d rays are wrong\n", wrong, view * view);
    return wrong != 0;
}
