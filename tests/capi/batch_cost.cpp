// What a batch through the C API costs beside the room's own: prints the median of their ratios, taken in
// turns. Not a test: built as `capi_batch_cost`, run by hand.
#include "filigree/encoding/map_reader.h"
#include "filigree/grid/encode_grids.h"
#include "filigree/grid/heightfield.h"
#include "filigree/grid/lattice_choice.h"
#include "filigree/grid/rays.h"

#include "filigree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

namespace {

using namespace filigree;

constexpr size_t queries = size_t{1} << 18;
constexpr int rounds = 25;

// Of the processor: other programs do not count.
template <class Work>
double secondsOf(Work&& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

template <class Own, class FromC>
void compare(const char* what, size_t count, Own&& own, FromC&& fromC) {
    std::vector<double> ratios;
    std::vector<double> times;
    for (int round = 0; round < rounds; ++round) {
        const double first = secondsOf(own);
        const double both = secondsOf(fromC) + secondsOf(fromC);
        const double last = secondsOf(own);
        ratios.push_back(both / (first + last));
        times.push_back((first + last) / 2);
    }
    std::printf("%-24s own %7.2f ns each, C / own %.3f\n", what,
                median(times) / static_cast<double>(count) * 1e9, median(ratios));
}

// 400 triangles over blobs of alpha, level 6.
filigree_micromaps* bakedBlobs() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<float> alpha(256 * 256);
    for (size_t k = 0; k < alpha.size(); ++k) {
        const auto x = static_cast<float>(k % 256);
        const auto y = static_cast<float>(k / 256);
        alpha[k] = 0.5F + 0.5F * std::sin(x / 7) * std::cos(y / 9 + x / 30);
    }
    std::vector<float> uvs(400 * 6);
    for (float& coordinate : uvs) coordinate = uniform(random);
    filigree_image image = FILIGREE_IMAGE_INIT;
    image.texels = alpha.data();
    image.width = image.height = 256;
    image.texel = FILIGREE_TEXEL_F32;
    filigree_triangles triangles = FILIGREE_TRIANGLES_INIT;
    triangles.triangle_count = 400;
    triangles.uvs = uvs.data();
    filigree_bake_settings settings = FILIGREE_BAKE_SETTINGS_INIT;
    settings.level = 6;
    filigree_micromaps* maps = nullptr;
    filigree_bake(nullptr, &triangles, &image, nullptr, &settings, nullptr, &maps, nullptr);
    return maps;
}

void compareLookups(const filigree_micromaps* micromaps, filigree_encoding kind, const char* name) {
    filigree_encode_settings settings = FILIGREE_ENCODE_SETTINGS_INIT;
    settings.encoding = static_cast<uint32_t>(kind);
    filigree_set* set = nullptr;
    filigree_encode(nullptr, micromaps, &settings, nullptr, &set, nullptr);
    filigree_set_blocks blocks = FILIGREE_SET_BLOCKS_INIT;
    filigree_set_get_blocks(set, &blocks, nullptr);
    const auto reader = encoding::openReader({static_cast<encoding::Encoding>(blocks.encoding),
                                              micromap::Format::fourState,
                                              blocks.map_count,
                                              {blocks.descriptors, blocks.descriptor_bytes},
                                              {blocks.payload, blocks.payload_bytes}});
    std::mt19937 random(2);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<uint32_t> maps(queries);
    std::vector<uint32_t> indices(queries);
    std::vector<float> u(queries);
    std::vector<float> v(queries);
    std::vector<uint8_t> states(queries);
    for (size_t k = 0; k < queries; ++k) {
        maps[k] = random() % blocks.map_count;
        u[k] = uniform(random);
        v[k] = uniform(random) * (1 - u[k]);
        indices[k] = filigree_curve_index(u[k], v[k], 6);
    }
    const std::span to(reinterpret_cast<micromap::State*>(states.data()), queries);
    char what[64];
    std::snprintf(what, sizeof what, "%s, points", name);
    compare(
        what, queries, [&] { (*reader)->lookup(maps, u, v, to); },
        [&] { filigree_set_lookup(set, queries, maps.data(), u.data(), v.data(), states.data(), nullptr); });
    std::snprintf(what, sizeof what, "%s, indices", name);
    compare(
        what, queries, [&] { (*reader)->lookup(maps, indices, to); },
        [&] { filigree_set_lookup_at(set, queries, maps.data(), indices.data(), states.data(), nullptr); });
    filigree_set_destroy(set);
}

void compareRays() {
    constexpr uint32_t side = 513;
    std::vector<float> heights(size_t{side} * side);
    const auto heightOf = [](uint32_t x, uint32_t y) {
        return 20 * std::sin(static_cast<float>(x) / 31) * std::cos(static_cast<float>(y) / 23);
    };
    for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) heights[size_t{y} * side + x] = heightOf(x, y);
    }
    filigree_heightfield field = FILIGREE_HEIGHTFIELD_INIT;
    field.heights = heights.data();
    field.columns = field.rows = side;
    field.type = FILIGREE_TEXEL_F32;
    filigree_grid_settings settings = FILIGREE_GRID_SETTINGS_INIT;
    settings.precision = FILIGREE_GRID_MAX_ERROR;
    settings.max_error = 0.01;
    filigree_grids* grids = nullptr;
    filigree_tracer* tracer = nullptr;
    filigree_grids_create_from_heights(nullptr, &field, &settings, nullptr, &grids, nullptr);
    filigree_tracer_create(nullptr, grids, &tracer, nullptr);

    grid::GridMesh mesh = grid::gridOfHeights(side, side, 1, heightOf);
    grid::EncodeOptions options;
    options.lattice = *grid::latticeForError(mesh, 0.01);
    const auto encoded = grid::encodeGrids(mesh, options);
    grid::Tracer own(*encoded);
    constexpr size_t count = queries / 8;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<grid::Ray> rays(count);
    std::vector<filigree_ray> cRays(count);
    for (size_t k = 0; k < count; ++k) {
        rays[k] = {{256 + 250 * uniform(random), 60, 256 + 250 * uniform(random)},
                   {uniform(random), -1, uniform(random)}};
        cRays[k] = {{rays[k].origin[0], 60, rays[k].origin[2]},
                    {rays[k].direction[0], -1, rays[k].direction[2]},
                    0,
                    rays[k].tMax};
    }
    std::vector<grid::Hit> hits(count);
    std::vector<filigree_hit> cHits(count);
    std::vector<uint8_t> answers(count);
    compare(
        "rays, closest", count, [&] { own.closest(rays, hits); },
        [&] { filigree_tracer_closest(tracer, count, cRays.data(), 0, cHits.data(), 0, nullptr); });
    compare(
        "rays, any", count, [&] { own.any(rays, answers); },
        [&] { filigree_tracer_any(tracer, count, cRays.data(), 0, answers.data(), nullptr); });
    filigree_tracer_destroy(tracer);
    filigree_grids_destroy(grids);
}

}  // namespace

int main() {
    filigree_micromaps* maps = bakedBlobs();
    compareLookups(maps, FILIGREE_ENCODING_FLAT, "flat");
    compareLookups(maps, FILIGREE_ENCODING_GRUEN, "gruen");
    compareLookups(maps, FILIGREE_ENCODING_DAG, "dag");
    compareLookups(maps, FILIGREE_ENCODING_SDAG, "sdag");
    filigree_micromaps_destroy(maps);
    compareRays();
    return 0;
}
