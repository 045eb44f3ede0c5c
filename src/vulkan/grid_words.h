// Compressed grids as the words that shaders read (shaders/trace/grids.glsl), and the boxes that rays meet.
#pragma once

#include "filigree/core/box.h"
#include "filigree/vulkan/ray_scene.h"

#include "vulkan/device_data.h"
#include "vulkan/scene_words.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::vulkan {

// What stands before the offsets of the records. Places are numbers of words.
struct GridWords {
    std::array<float, 3> origin{};      // world = origin + step * coordinate
    std::array<float, 3> originRest{};  // what rounding took off the origin
    std::array<float, 3> step{};
    std::array<float, 3> perStep{};
    std::array<float, 3> largest{};  // coordinates
    uint32_t recordsAt = 0;
    uint32_t normalsAt = noWord;  // a GridNormalWords; noWord: flat triangles
};
static_assert(sizeof(GridWords) == 68);

// Before the columns and the first vertex of each grid, two words a grid. noWord: there are none.
struct GridNormalWords {
    uint32_t vertices = noWord;        // x, y, z of each vertex of all grids
    uint32_t loose = noWord;           // of loose vertices
    uint32_t looseTriangles = noWord;  // three numbers of loose vertices each
};

// Puts the grids behind `words` and says where. `boxes`: recordBoxes of them. ErrorKind::limit where floats
// do not hold the lattice, or 2^30 words do not hold it all.
Result<uint32_t> appendGrids(const GridPart& part, std::span<const Box> boxes, std::vector<uint32_t>& words);

// In world units, wider by what rounding may take.
std::vector<VkAabbPositionsKHR> gridAabbs(const grid::Lattice& lattice, std::span<const Box> boxes);

}  // namespace filigree::vulkan
