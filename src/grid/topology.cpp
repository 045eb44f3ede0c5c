#include "grid/topology.h"

#include "grid/buckets.h"
#include "grid/weld.h"

#include <algorithm>
#include <span>

namespace filigree::grid {
namespace {

void addFace(const mesh::Face& face, const std::vector<uint32_t>& firsts, Topology& topology) {
    const auto vertex = [&](size_t k) { return firsts[face[k]]; };
    topology.triangles.push_back({vertex(0), vertex(1), vertex(2)});
    topology.diagonal.push_back(noCorner);
    if (!mesh::isQuad(face)) return;
    topology.triangles.push_back({vertex(0), vertex(2), vertex(3)});
    topology.diagonal.push_back(noCorner);
    const auto last = static_cast<uint32_t>(topology.triangles.size() - 1);
    if (topology.hasThreeVertices(last - 1) && topology.hasThreeVertices(last)) {
        topology.diagonal[last - 1] = 2;
        topology.diagonal[last] = 0;
    }
}

// How many triangles before each one have its three vertices: [triangle_count].
std::vector<uint32_t> sheetsOf(const Topology& topology, size_t vertexCount) {
    const auto sorted = [&](uint32_t t) {
        std::array<uint32_t, 3> vertices = topology.triangles[t];
        std::ranges::sort(vertices);
        return vertices;
    };
    const auto least = [&](size_t t) { return std::ranges::min(topology.triangles[t]); };
    Buckets buckets(vertexCount, topology.triangles.size(), least);
    std::vector<uint32_t> sheets(topology.triangles.size());
    for (size_t v = 0; v < vertexCount; ++v) {
        const std::span<uint32_t> here = buckets.bucket(v);
        std::ranges::sort(
            here, [&](uint32_t a, uint32_t b) { return std::pair(sorted(a), a) < std::pair(sorted(b), b); });
        for (size_t k = 1; k < here.size(); ++k) {
            if (sorted(here[k]) == sorted(here[k - 1])) sheets[here[k]] = sheets[here[k - 1]] + 1;
        }
    }
    return sheets;
}

// Joins the half-edges of one edge and sheet where they are two of opposite direction.
void joinTwins(std::span<const uint32_t> edges, Topology& topology) {
    if (edges.size() != 2) return;
    const auto [a, b] = std::pair(edges[0], edges[1]);
    if (topology.from(a) == topology.from(b)) return;
    topology.twins[a] = b;
    topology.twins[b] = a;
}

void findTwins(size_t vertexCount, Topology& topology) {
    const std::vector<uint32_t> sheets = sheetsOf(topology, vertexCount);
    const auto to = [&](uint32_t edge) { return topology.from(nextEdge(edge)); };
    const auto least = [&](size_t e) {
        const auto edge = static_cast<uint32_t>(e);
        return topology.hasThreeVertices(edge / 3) ? std::min(topology.from(edge), to(edge)) : noBucket;
    };
    const auto key = [&](uint32_t edge) {
        return std::pair(std::max(topology.from(edge), to(edge)), sheets[edge / 3]);
    };
    topology.twins.assign(3 * topology.triangles.size(), noEdge);
    Buckets buckets(vertexCount, topology.twins.size(), least);
    for (size_t v = 0; v < vertexCount; ++v) {
        const std::span<uint32_t> here = buckets.bucket(v);
        std::ranges::sort(
            here, [&](uint32_t a, uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
        for (size_t first = 0, last = 0; first < here.size(); first = last) {
            while (last < here.size() && key(here[last]) == key(here[first])) ++last;
            joinTwins(here.subspan(first, last - first), topology);
        }
    }
}

}  // namespace

Topology topologyOf(const mesh::FaceMesh& mesh, bool attributes) {
    WeldInput vertices{mesh.positions, {}, {}};
    if (attributes) vertices = {mesh.positions, mesh.normals, mesh.uvs};
    const std::vector<uint32_t> firsts = weld(vertices);
    Topology topology;
    const uint64_t triangles = mesh.triangleCount();
    topology.triangles.reserve(triangles);
    topology.diagonal.reserve(triangles);
    for (const mesh::Face& face : mesh.faces) addFace(face, firsts, topology);
    findTwins(mesh.positions.size(), topology);
    return topology;
}

}  // namespace filigree::grid
