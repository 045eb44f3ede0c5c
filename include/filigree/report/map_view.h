// An interactive view for pages: textures, the triangles over them, and the maps that cut these into cells of
// four states. Readers zoom, filter and ask what lies under the pointer; everything travels inside the page.
#pragma once

#include "filigree/report/drawing.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace filigree::report {

// How the cells of one triangle lie: in a tree whose nodes have four children, along the curve of
// VK_KHR_opacity_micromap.
struct CellMap {
    uint32_t record = 0;  // its number for people
    unsigned storedLevel = 0;
    unsigned level = 0;               // of `inner` and `finest`; below storedLevel where a page holds less
    unsigned states = 4;              // 2 or 4
    uint64_t bytes = 0;               // that it takes where it is stored
    uint64_t sharers = 0;             // triangles that use it
    std::array<uint64_t, 4> cells{};  // by state, at storedLevel
    std::vector<uint8_t> inner;       // see packMaps
    std::vector<uint8_t> finest;
};

// A triangle in the texture. Equal ones stand once.
struct PlacedTriangle {
    std::array<float, 6> uv{};  // u0 v0 u1 v1 u2 v2, 1 the whole texture
    int32_t map = -1;           // into the texture's maps; -1 - state for a triangle of one state throughout
    uint64_t equals = 1;        // triangles that are the same, itself too
    uint32_t mesh = 0;          // where the first of these is found
    uint32_t primitive = 0;
    uint32_t triangle = 0;
};

enum class Edge : uint8_t { repeat, mirror, clamp };

struct MappedTexture {
    std::string name;
    std::string note;          // below the picture; empty for none
    std::vector<uint8_t> png;  // the alpha in grey, `width` x `height` or the same shape smaller
    uint32_t width = 0;        // texels
    uint32_t height = 0;
    std::array<Edge, 2> edges{};     // what lies beyond the texture in u and v
    bool nearest = false;            // texels are shown with hard edges
    uint64_t triangles = 0;          // before equal ones were put together
    uint64_t mostOverlaps = 0;       // distinct triangles over one texel
    std::array<double, 4> shares{};  // of the area, by state
    size_t shownTriangles = 0;       // in `packedTriangles`
    size_t maps = 0;                 // in `packedMaps`
    std::string packedTriangles;     // see packTriangles
    std::string packedMaps;
};

struct State {
    std::string name;
    Colour colour;
};

struct MapView {
    std::array<State, 4> states;
    std::vector<MappedTexture> textures;
    std::string caption;
    std::string command;  // that makes it again; empty for none
};

// Columns of 32-bit numbers, each as four planes of bytes, lowest first: record, storedLevel, level, states,
// bytes, sharers, cells x 4, and the lengths of `inner` in nodes and of `finest` in bytes; then all `inner`,
// then all `finest`. Values that do not fit are cut to the largest. Compressed, in base64.
//
// A map whose cells all have one state has neither. Otherwise its nodes stand depth first: one whose children
// are cells is a byte of `finest`, their states with two bits each from the lowest on; any other is two bytes
// of `inner`, the low four bits of the first telling which children have nodes of their own, the second the
// states of the rest.
std::string packMaps(std::span<const CellMap> maps);

// The same columns: the bits of uv x 6, map, equals, mesh, primitive, triangle.
std::string packTriangles(std::span<const PlacedTriangle> triangles);

// A <figure> that the page's script brings to life.
std::string toHtml(const MapView& view);

}  // namespace filigree::report
