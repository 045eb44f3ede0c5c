#include "filigree/trace/embree_grids.h"

#include "trace/embree_ray.h"
#include "trace/world_data.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace filigree::trace {

// Vertices and what is made of them, shared with Embree.
struct EmbreeBuffers {
    std::vector<Vec3> vertices;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<RTCGrid> grids;

    [[nodiscard]] uint64_t bytes() const {
        return vertices.size() * sizeof(Vec3) + triangles.size() * sizeof(triangles[0]) +
               grids.size() * sizeof(RTCGrid);
    }
};

namespace {

using grid::Diagonal;
using grid::GridMesh;
using grid::VertexGrid;

constexpr std::array<std::string_view, embreeLayoutCount> layoutNames{
    "triangles", "triangles-compact", "triangles-qbvh8", "grids", "grids-compact"};

// What Embree may read past the last vertex.
constexpr size_t vertexPadding = 1;
constexpr size_t longestGridSide = 32767;  // vertices
constexpr size_t streamLength = 128;       // rays

bool isGridLayout(EmbreeLayout layout) {
    return layout == EmbreeLayout::grids || layout == EmbreeLayout::gridsCompact;
}
bool isCompactLayout(EmbreeLayout layout) {
    return layout == EmbreeLayout::trianglesCompact || layout == EmbreeLayout::gridsCompact;
}

bool countGridMemory(void* bytes, ssize_t change, bool) {
    *static_cast<std::atomic<int64_t>*>(bytes) += change;
    return true;
}

// The triangles of a quad whose vertex a has number `a`.
std::array<std::array<uint32_t, 3>, 2> trianglesOfQuad(uint32_t a, uint32_t columns, Diagonal diagonal) {
    const uint32_t b = a + 1;
    const uint32_t c = a + columns + 1;
    const uint32_t d = a + columns;
    if (diagonal == Diagonal::ac) return {{{a, b, c}, {a, c, d}}};
    return {{{a, b, d}, {b, c, d}}};
}

EmbreeBuffers allTriangles(const GridMesh& mesh) {
    EmbreeBuffers buffers;
    buffers.vertices.reserve(mesh.vertices.size() + mesh.looseVertices.size() + vertexPadding);
    buffers.vertices = mesh.vertices;
    buffers.vertices.insert(buffers.vertices.end(), mesh.looseVertices.begin(), mesh.looseVertices.end());
    buffers.vertices.resize(buffers.vertices.size() + vertexPadding);
    buffers.triangles.reserve(mesh.triangleCount());
    for (const VertexGrid& grid : mesh.grids) {
        uint64_t quad = grid.firstQuad;
        for (uint64_t row = 0; row + 1 < grid.rows; ++row) {
            for (uint64_t column = 0; column + 1 < grid.columns; ++column, ++quad) {
                const uint64_t a = grid.firstVertex + row * grid.columns + column;
                for (const auto& triangle :
                     trianglesOfQuad(static_cast<uint32_t>(a), grid.columns, mesh.diagonalOf(quad)))
                    buffers.triangles.push_back(triangle);
            }
        }
    }
    const auto firstLoose = static_cast<uint32_t>(mesh.vertices.size());
    for (const auto& t : mesh.looseTriangles)
        buffers.triangles.push_back({t[0] + firstLoose, t[1] + firstLoose, t[2] + firstLoose});
    return buffers;
}

EmbreeBuffers looseTriangles(const GridMesh& mesh) {
    EmbreeBuffers buffers;
    buffers.vertices = mesh.looseVertices;
    buffers.vertices.resize(buffers.vertices.size() + vertexPadding);
    buffers.triangles = mesh.looseTriangles;
    return buffers;
}

Diagonal usualDiagonal(const GridMesh& mesh, const VertexGrid& grid) {
    if (mesh.diagonals.empty()) return Diagonal::ac;
    const auto first = mesh.diagonals.begin() + static_cast<std::ptrdiff_t>(grid.firstQuad);
    const auto count = static_cast<std::ptrdiff_t>(grid.quadCount());
    return 2 * std::count(first, first + count, Diagonal::ac) >= count ? Diagonal::ac : Diagonal::bd;
}

// A grid in pieces that Embree can take.
void addGridPieces(const VertexGrid& grid, std::vector<RTCGrid>& to) {
    constexpr uint64_t step = longestGridSide - 1;
    for (uint64_t row = 0; row + 1 < grid.rows; row += step) {
        for (uint64_t column = 0; column + 1 < grid.columns; column += step) {
            RTCGrid piece;
            piece.startVertexID = static_cast<unsigned>(grid.firstVertex + row * grid.columns + column);
            piece.stride = grid.columns;
            piece.width = static_cast<uint16_t>(std::min<uint64_t>(longestGridSide, grid.columns - column));
            piece.height = static_cast<uint16_t>(std::min<uint64_t>(longestGridSide, grid.rows - row));
            to.push_back(piece);
        }
    }
}

EmbreeBuffers allGrids(const GridMesh& mesh) {
    EmbreeBuffers buffers;
    buffers.vertices.reserve(mesh.vertices.size() + vertexPadding);
    buffers.vertices = mesh.vertices;
    for (const VertexGrid& grid : mesh.grids) {
        addGridPieces(grid, buffers.grids);
        if (usualDiagonal(mesh, grid) == Diagonal::bd) continue;
        for (uint64_t row = 0; row < grid.rows; ++row) {
            const auto first =
                buffers.vertices.begin() + static_cast<std::ptrdiff_t>(grid.firstVertex + row * grid.columns);
            std::reverse(first, first + grid.columns);
        }
    }
    buffers.vertices.resize(buffers.vertices.size() + vertexPadding);
    return buffers;
}

RTCRay embreeGridRay(const grid::Ray& from) {
    return embreeRay(from.origin, from.direction, from.tMin, from.tMax);
}

RTCRayHit embreeGridQuery(const grid::Ray& from) {
    RTCRayHit query;
    query.ray = embreeGridRay(from);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
}

EmbreeHit embreeGridHit(const RTCRayHit& found) {
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {found.ray.tfar,
            found.hit.primID,
            found.hit.u,
            found.hit.v,
            {found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z}};
}

}  // namespace

struct EmbreeGrids::Data {
    std::atomic<int64_t> embreeBytes{0};  // outlives the device, which counts into it
    EmbreeBuffers main;
    EmbreeBuffers loose;
    DeviceOwner device;
    SceneOwner scene;
    double buildSeconds = 0;
    bool hasStreams = true;

    void attach(EmbreeBuffers& buffers);
    Status build(EmbreeLayout layout, const EmbreeOptions& options);
};

void EmbreeGrids::Data::attach(EmbreeBuffers& buffers) {
    const bool isGrids = !buffers.grids.empty();
    if (!isGrids && buffers.triangles.empty()) return;
    RTCGeometry geometry =
        rtcNewGeometry(device.get(), isGrids ? RTC_GEOMETRY_TYPE_GRID : RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               buffers.vertices.data(), 0, sizeof(Vec3),
                               buffers.vertices.size() - vertexPadding);
    if (isGrids) {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, buffers.grids.data(),
                                   0, sizeof(RTCGrid), buffers.grids.size());
    } else {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   buffers.triangles.data(), 0, sizeof(buffers.triangles[0]),
                                   buffers.triangles.size());
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
}

Status EmbreeGrids::Data::build(EmbreeLayout layout, const EmbreeOptions& options) {
    std::string config = fmt::format("threads={}", options.threads);
    hasStreams = layout != EmbreeLayout::trianglesQbvh8;
    if (layout == EmbreeLayout::trianglesQbvh8) config += ",tri_accel=qbvh8.triangle4i";
    device.reset(rtcNewDevice(config.c_str()));
    if (!device) return Error{ErrorKind::limit, "Embree cannot start on this machine"};
    rtcSetDeviceMemoryMonitorFunction(device.get(), countGridMemory, &embreeBytes);
    scene.reset(rtcNewScene(device.get()));
    unsigned flags = RTC_SCENE_FLAG_NONE;
    if (options.robust) flags |= RTC_SCENE_FLAG_ROBUST;
    if (isCompactLayout(layout)) flags |= RTC_SCENE_FLAG_COMPACT;
    rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(flags));
    attach(main);
    attach(loose);
    const auto start = std::chrono::steady_clock::now();
    rtcCommitScene(scene.get());
    buildSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (rtcGetDeviceError(device.get()) == RTC_ERROR_NONE) return {};
    return Error{ErrorKind::limit,
                 fmt::format("the grids do not fit into memory under Embree as {}", nameOf(layout))};
}

std::string_view nameOf(EmbreeLayout layout) {
    return layoutNames[static_cast<size_t>(layout)];
}
std::optional<EmbreeLayout> embreeLayoutNamed(std::string_view name) {
    const auto found = std::ranges::find(layoutNames, name);
    if (found == layoutNames.end()) return std::nullopt;
    return static_cast<EmbreeLayout>(found - layoutNames.begin());
}

Result<EmbreeGrids> EmbreeGrids::build(const grid::GridMesh& mesh, EmbreeLayout layout,
                                       const EmbreeOptions& options) {
    auto data = std::make_unique<Data>();
    if (isGridLayout(layout)) {
        data->main = allGrids(mesh);
        data->loose = looseTriangles(mesh);
    } else {
        data->main = allTriangles(mesh);
    }
    if (const Status built = data->build(layout, options); !built) return built.error();
    return EmbreeGrids(std::move(data));
}

EmbreeGrids::EmbreeGrids(std::unique_ptr<Data> data) : data_(std::move(data)) {}
EmbreeGrids::EmbreeGrids(EmbreeGrids&&) noexcept = default;
EmbreeGrids& EmbreeGrids::operator=(EmbreeGrids&&) noexcept = default;
EmbreeGrids::~EmbreeGrids() = default;

uint64_t EmbreeGrids::bytes() const {
    return static_cast<uint64_t>(std::max<int64_t>(0, data_->embreeBytes)) + data_->main.bytes() +
           data_->loose.bytes();
}
double EmbreeGrids::buildSeconds() const {
    return data_->buildSeconds;
}

void EmbreeGrids::closest(std::span<const grid::Ray> rays, std::span<EmbreeHit> hits) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t k = 0; k < rays.size(); ++k) {
        RTCRayHit query = embreeGridQuery(rays[k]);
        rtcIntersect1(data_->scene.get(), &context, &query);
        hits[k] = embreeGridHit(query);
    }
}

void EmbreeGrids::any(std::span<const grid::Ray> rays, std::span<uint8_t> answers) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t k = 0; k < rays.size(); ++k) {
        RTCRay query = embreeGridRay(rays[k]);
        rtcOccluded1(data_->scene.get(), &context, &query);
        answers[k] = query.tfar < 0 ? 1 : 0;
    }
}

void EmbreeGrids::closestStreamed(std::span<const grid::Ray> rays, std::span<EmbreeHit> hits) const {
    if (!data_->hasStreams) return closest(rays, hits);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    std::array<RTCRayHit, streamLength> queries;
    for (size_t first = 0; first < rays.size(); first += streamLength) {
        const size_t count = std::min(streamLength, rays.size() - first);
        for (size_t k = 0; k < count; ++k) queries[k] = embreeGridQuery(rays[first + k]);
        rtcIntersect1M(data_->scene.get(), &context, queries.data(), static_cast<unsigned>(count),
                       sizeof(RTCRayHit));
        for (size_t k = 0; k < count; ++k) hits[first + k] = embreeGridHit(queries[k]);
    }
}

void EmbreeGrids::anyStreamed(std::span<const grid::Ray> rays, std::span<uint8_t> answers) const {
    if (!data_->hasStreams) return any(rays, answers);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    std::array<RTCRay, streamLength> queries;
    for (size_t first = 0; first < rays.size(); first += streamLength) {
        const size_t count = std::min(streamLength, rays.size() - first);
        for (size_t k = 0; k < count; ++k) queries[k] = embreeGridRay(rays[first + k]);
        rtcOccluded1M(data_->scene.get(), &context, queries.data(), static_cast<unsigned>(count),
                      sizeof(RTCRay));
        for (size_t k = 0; k < count; ++k) answers[first + k] = queries[k].tfar < 0 ? 1 : 0;
    }
}

}  // namespace filigree::trace
