// Any bytes as a .fil file, once as they are and once with their hashes made right, so that what lies behind
// the hashes is reached. None may crash, hang or take much memory; grids that are accepted may be traced.
#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/map_reader.h"
#include "filigree/grid/decode_grids.h"
#include "filigree/grid/rays.h"
#include "filigree/io/fil.h"
#include "filigree/io/fil_grids.h"
#include "filigree/io/fil_squares.h"

#include "sample_fil.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace {

void readAll(std::vector<uint8_t> bytes) {
    using namespace filigree;
    io::FilReadOptions options;
    options.maxBytes = uint64_t{64} << 20;
    const auto file = io::FilFile::parse(std::move(bytes), "input", options);
    if (!file) return;
    if (file->set().encoding == encoding::Encoding::bitmask) {
        static_cast<void>(encoding::BitmaskReader::open(file->set()).ok());
        return;
    }
    std::vector<int32_t> indices(file->meta().triangleCount());
    file->readIndices(0, indices);
    static_cast<void>(encoding::openReader(file->set()).ok());
}

void readSquares(std::vector<uint8_t> bytes) {
    using namespace filigree;
    io::FilReadOptions options;
    options.maxBytes = uint64_t{64} << 20;
    const auto file = io::FilSquareFile::parse(std::move(bytes), "input", options);
    if (!file) return;
    std::vector<int32_t> indices(file->meta().triangleCount());
    file->readIndices(0, indices);
    for (size_t t = 0; t < indices.size(); ++t) {
        static_cast<void>(quadmap::verticesOf(file->place(t)));
        if (indices[t] >= 0) static_cast<void>(file->maps().decode(static_cast<size_t>(indices[t])));
    }
}

filigree::Vec3 pointIn(const filigree::Box& box, unsigned seed) {
    filigree::Vec3 point{};
    for (size_t axis = 0; axis < 3; ++axis, seed = seed * 1664525U + 1013904223U)
        point[axis] = box.low[axis] + (box.high[axis] - box.low[axis]) * static_cast<float>(seed >> 24) / 255;
    return point;
}

// Through the decoded vertices' box, and what is found there shaded.
void traceThrough(const filigree::io::FilGrids& file, const filigree::grid::DecodedGrids& decoded) {
    using namespace filigree;
    Box box;
    for (const Vec3& vertex : decoded.vertices) box.extend(vertex);
    for (const auto& triangle : decoded.looseTriangles) {
        for (const Vec3& corner : triangle) box.extend(corner);
    }
    std::array<grid::Ray, 24> rays;
    for (unsigned k = 0; k < rays.size(); ++k) {
        rays[k].origin = pointIn(box, 2 * k);
        rays[k].direction = minus(pointIn(box, 2 * k + 1), rays[k].origin);
        if (dot(rays[k].direction, rays[k].direction) == 0) rays[k].direction = {0, 1, 0};
    }
    grid::Tracer tracer(file.grids);
    std::array<grid::Hit, rays.size()> hits;
    tracer.closest(rays, hits);
    for (size_t k = 0; k < rays.size(); ++k) {
        static_cast<void>(tracer.any(rays[k]));
        const grid::Hit hit = tracer.closest(rays[k]);
        if (hit.grid != hits[k].grid || hit.t != hits[k].t) std::abort();
        if (hit.grid != grid::noGrid) static_cast<void>(surfaceAt(file.attributes, file.table, hit));
    }
}

void readGrids(std::span<const uint8_t> bytes) {
    using namespace filigree;
    io::FilReadOptions options;
    options.maxBytes = uint64_t{64} << 20;
    const auto file = io::parseFilGrids(bytes, "input", serialExecutor(), options);
    if (file)
        traceThrough(*file,
                     grid::decodeGrids(file->grids, file->table, file->looseTriangles, serialExecutor()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::vector<uint8_t> bytes(data, data + size);
    readAll(bytes);
    readSquares(bytes);
    readGrids(bytes);
    filigree::tests::resealFil(bytes);
    readGrids(bytes);
    readAll(bytes);
    readSquares(std::move(bytes));
    return 0;
}
