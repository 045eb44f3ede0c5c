#include "vulkan/shaders.h"

#include "shaders/any_hit_bitmask.h"
#include "shaders/any_hit_dag.h"
#include "shaders/any_hit_flat.h"
#include "shaders/any_hit_gruen.h"
#include "shaders/any_hit_indexed_tree.h"
#include "shaders/any_hit_none.h"
#include "shaders/any_hit_sdag.h"
#include "shaders/any_hit_tree.h"
#include "shaders/any_hit_vq2.h"
#include "shaders/any_hit_vq2_plus.h"
#include "shaders/any_hit_vq4.h"
#include "shaders/any_hit_vq4_plus.h"
#include "shaders/lookup_bitmask.h"
#include "shaders/lookup_dag.h"
#include "shaders/lookup_flat.h"
#include "shaders/lookup_grids.h"
#include "shaders/lookup_gruen.h"
#include "shaders/lookup_indexed_tree.h"
#include "shaders/lookup_sdag.h"
#include "shaders/lookup_tree.h"
#include "shaders/lookup_vq2.h"
#include "shaders/lookup_vq2_plus.h"
#include "shaders/lookup_vq4.h"
#include "shaders/lookup_vq4_plus.h"
#include "shaders/picture_bitmask.h"
#include "shaders/picture_dag.h"
#include "shaders/picture_flat.h"
#include "shaders/picture_gruen.h"
#include "shaders/picture_indexed_tree.h"
#include "shaders/picture_micromaps.h"
#include "shaders/picture_none.h"
#include "shaders/picture_sdag.h"
#include "shaders/picture_tree.h"
#include "shaders/picture_vq2.h"
#include "shaders/picture_vq2_plus.h"
#include "shaders/picture_vq4.h"
#include "shaders/picture_vq4_plus.h"
#include "shaders/ray_closest_hit.h"
#include "shaders/ray_generation.h"
#include "shaders/ray_generation_micromaps.h"
#include "shaders/ray_grid_hit.h"
#include "shaders/ray_grid_intersection.h"
#include "shaders/ray_miss.h"

#include <array>

namespace filigree::vulkan {
namespace {

using Codes = std::array<std::span<const uint32_t>, decoderCount>;

constexpr Codes lookups{lookup_flat,         lookup_gruen, lookup_bitmask,  lookup_tree,
                        lookup_indexed_tree, lookup_dag,   lookup_sdag,     lookup_vq2,
                        lookup_vq2_plus,     lookup_vq4,   lookup_vq4_plus, std::span<const uint32_t>()};
constexpr Codes pictures{picture_flat,         picture_gruen, picture_bitmask,  picture_tree,
                         picture_indexed_tree, picture_dag,   picture_sdag,     picture_vq2,
                         picture_vq2_plus,     picture_vq4,   picture_vq4_plus, picture_none};

constexpr Codes anyHits{any_hit_flat,         any_hit_gruen, any_hit_bitmask,  any_hit_tree,
                        any_hit_indexed_tree, any_hit_dag,   any_hit_sdag,     any_hit_vq2,
                        any_hit_vq2_plus,     any_hit_vq4,   any_hit_vq4_plus, any_hit_none};

}  // namespace

std::span<const uint32_t> codeOf(Shader shader) {
    const auto decoder = static_cast<size_t>(shader.decoder);
    switch (shader.kind) {
        case ShaderKind::lookup:
            return lookups[decoder];
        case ShaderKind::gridLookup:
            return lookup_grids;
        case ShaderKind::picture:
            return shader.micromaps ? std::span<const uint32_t>(picture_micromaps) : pictures[decoder];
        case ShaderKind::rayGeneration:
            return shader.micromaps ? std::span<const uint32_t>(ray_generation_micromaps) : ray_generation;
        case ShaderKind::miss:
            return ray_miss;
        case ShaderKind::closestHit:
            return ray_closest_hit;
        case ShaderKind::gridHit:
            return ray_grid_hit;
        case ShaderKind::gridIntersection:
            return ray_grid_intersection;
        case ShaderKind::anyHit:
            break;
    }
    return anyHits[decoder];
}

}  // namespace filigree::vulkan
