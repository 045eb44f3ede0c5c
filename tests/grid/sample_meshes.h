// Meshes made in code, pleasant and nasty, for conversion and clusters.
#pragma once

#include "filigree/mesh/face_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace filigree::tests {

using mesh::FaceMesh;
using mesh::noVertex;

inline float coordinate(std::mt19937& random) {
    return static_cast<float>(random() % 1000) / 1000.0F;
}

// A wavy sheet of columns x rows quads. `wrapColumns` and `wrapRows` use the first vertices again at the end.
struct SheetShape {
    uint32_t columns = 8;
    uint32_t rows = 8;
    bool wrapColumns = false;
    bool wrapRows = false;
};

inline uint32_t sheetVertex(const SheetShape& shape, uint32_t column, uint32_t row) {
    const uint32_t across = shape.columns + (shape.wrapColumns ? 0 : 1);
    const uint32_t down = shape.rows + (shape.wrapRows ? 0 : 1);
    return row % down * across + column % across;
}

inline std::vector<Vec3> sheetPositions(const SheetShape& shape) {
    const uint32_t across = shape.columns + (shape.wrapColumns ? 0 : 1);
    const uint32_t down = shape.rows + (shape.wrapRows ? 0 : 1);
    std::vector<Vec3> positions;
    for (uint32_t row = 0; row < down; ++row) {
        for (uint32_t column = 0; column < across; ++column) {
            const auto x = static_cast<float>(column);
            const auto z = static_cast<float>(row);
            if (!shape.wrapColumns) {
                positions.push_back({x, 0.3F * std::sin(x) * std::cos(2 * z), z});
                continue;
            }
            const float u = 2 * std::numbers::pi_v<float> * x / static_cast<float>(shape.columns);
            const float v = 2 * std::numbers::pi_v<float> * z / static_cast<float>(shape.rows);
            positions.push_back({(3 + std::cos(v)) * std::cos(u), shape.wrapRows ? std::sin(v) : z,
                                 (3 + std::cos(v)) * std::sin(u)});
        }
    }
    return positions;
}

// The sheet's quads.
inline FaceMesh quadSheet(const SheetShape& shape) {
    FaceMesh mesh;
    mesh.positions = sheetPositions(shape);
    for (uint32_t row = 0; row < shape.rows; ++row) {
        for (uint32_t column = 0; column < shape.columns; ++column) {
            mesh.faces.push_back({sheetVertex(shape, column, row), sheetVertex(shape, column + 1, row),
                                  sheetVertex(shape, column + 1, row + 1),
                                  sheetVertex(shape, column, row + 1)});
        }
    }
    return mesh;
}

// Quads cut into triangles, each along the other diagonal with probability `turned` / 256.
inline FaceMesh inTriangles(const FaceMesh& quads, unsigned turned = 0, unsigned seed = 1) {
    std::mt19937 random(seed);
    FaceMesh mesh = quads;
    mesh.faces.clear();
    for (const auto& [a, b, c, d] : quads.faces) {
        if (random() % 256 < turned) {
            mesh.faces.push_back({b, c, d, noVertex});
            mesh.faces.push_back({b, d, a, noVertex});
        } else {
            mesh.faces.push_back({a, b, c, noVertex});
            mesh.faces.push_back({a, c, d, noVertex});
        }
    }
    return mesh;
}

// Faces in any order, each beginning at any of its vertices.
inline FaceMesh shuffled(FaceMesh mesh, unsigned seed) {
    std::mt19937 random(seed);
    std::shuffle(mesh.faces.begin(), mesh.faces.end(), random);
    for (mesh::Face& face : mesh.faces) {
        const auto end = mesh::isQuad(face) ? face.end() : face.end() - 1;
        std::rotate(face.begin(), face.begin() + random() % (end - face.begin()), end);
    }
    return mesh;
}

// Every face with vertices of its own.
inline FaceMesh soup(const FaceMesh& mesh) {
    FaceMesh soup;
    for (const mesh::Face& face : mesh.faces) {
        mesh::Face own = face;
        for (size_t k = 0; k < (mesh::isQuad(face) ? 4U : 3U); ++k) {
            own[k] = static_cast<uint32_t>(soup.positions.size());
            soup.positions.push_back(mesh.positions[face[k]]);
        }
        soup.faces.push_back(own);
    }
    return soup;
}

// A ball of triangles and quads with a pole at either end, both valence `around`.
inline FaceMesh ball(uint32_t around, uint32_t rings) {
    FaceMesh mesh;
    for (uint32_t ring = 1; ring < rings; ++ring) {
        const float v = std::numbers::pi_v<float> * static_cast<float>(ring) / static_cast<float>(rings);
        for (uint32_t k = 0; k < around; ++k) {
            const float u =
                2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(around);
            mesh.positions.push_back({std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u)});
        }
    }
    const auto north = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back({0, 1, 0});
    mesh.positions.push_back({0, -1, 0});
    const auto at = [&](uint32_t ring, uint32_t k) { return (ring - 1) * around + k % around; };
    for (uint32_t k = 0; k < around; ++k) {
        mesh.faces.push_back({north, at(1, k + 1), at(1, k), noVertex});
        mesh.faces.push_back({north + 1, at(rings - 1, k), at(rings - 1, k + 1), noVertex});
        for (uint32_t ring = 1; ring + 1 < rings; ++ring)
            mesh.faces.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)});
    }
    return mesh;
}

// A band of quads whose end is joined to its beginning upside down.
inline FaceMesh moebius(uint32_t around, uint32_t across) {
    FaceMesh mesh;
    const auto at = [&](uint32_t k, uint32_t w) { return k * (across + 1) + w; };
    for (uint32_t k = 0; k < around; ++k) {
        const float u = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(around);
        for (uint32_t w = 0; w <= across; ++w) {
            const float r = static_cast<float>(w) / static_cast<float>(across) - 0.5F;
            mesh.positions.push_back({(2 + r * std::cos(u / 2)) * std::cos(u), r * std::sin(u / 2),
                                      (2 + r * std::cos(u / 2)) * std::sin(u)});
        }
    }
    for (uint32_t k = 0; k < around; ++k) {
        for (uint32_t w = 0; w < across; ++w) {
            const bool last = k + 1 == around;
            const uint32_t b = last ? at(0, across - w) : at(k + 1, w);
            const uint32_t c = last ? at(0, across - w - 1) : at(k + 1, w + 1);
            mesh.faces.push_back({at(k, w), b, c, at(k, w + 1)});
        }
    }
    return mesh;
}

// A sheet that has seen better days: holes, faces turned over, doubled, moved to other vertices, degenerate.
inline FaceMesh nasty(unsigned seed) {
    std::mt19937 random(seed);
    const SheetShape shape{static_cast<uint32_t>(2 + random() % 20), static_cast<uint32_t>(2 + random() % 20),
                           random() % 2 == 0, random() % 3 == 0};
    FaceMesh mesh = quadSheet(shape);
    if (random() % 2 == 0) mesh = inTriangles(mesh, random() % 2 == 0 ? 0 : 128, seed);
    const size_t wounds = random() % 12;
    const auto anyFace = [&]() -> mesh::Face& { return mesh.faces[random() % mesh.faces.size()]; };
    for (size_t k = 0; k < wounds && mesh.faces.size() > 4; ++k) {
        mesh::Face& face = anyFace();
        switch (random() % 6) {
            case 0:
                mesh.faces.erase(mesh.faces.begin() + (&face - mesh.faces.data()));
                break;
            case 1:
                std::swap(face[0], face[2]);
                break;
            case 2:
                mesh.faces.push_back(mesh::Face(face));
                break;
            case 3:
                face[random() % 3] = static_cast<uint32_t>(random() % mesh.positions.size());
                break;
            case 4:
                face[1] = face[0];
                break;
            default:
                mesh.positions[face[0]] = mesh.positions[face[1]];
                break;
        }
    }
    return shuffled(std::move(mesh), seed);
}

// Triangles between any of a few vertices: many share an edge.
inline FaceMesh tangle(unsigned seed) {
    std::mt19937 random(seed);
    FaceMesh mesh;
    const size_t vertices = 3 + random() % 30;
    for (size_t v = 0; v < vertices; ++v)
        mesh.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
    const auto any = [&] { return static_cast<uint32_t>(random() % vertices); };
    for (size_t f = 0; f < 200; ++f)
        mesh.faces.push_back({any(), any(), any(), random() % 2 == 0 ? any() : noVertex});
    return mesh;
}

}  // namespace filigree::tests
