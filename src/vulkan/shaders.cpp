#include "vulkan/shaders.h"

#include "shaders/lookup_bitmask.h"
#include "shaders/lookup_dag.h"
#include "shaders/lookup_flat.h"
#include "shaders/lookup_gruen.h"
#include "shaders/lookup_indexed_tree.h"
#include "shaders/lookup_sdag.h"
#include "shaders/lookup_tree.h"
#include "shaders/lookup_vq2.h"
#include "shaders/lookup_vq2_plus.h"
#include "shaders/lookup_vq4.h"
#include "shaders/lookup_vq4_plus.h"

#include <array>

namespace filigree::vulkan {
namespace {

constexpr std::array<std::span<const uint32_t>, decoderCount> lookups{
    lookup_flat, lookup_gruen, lookup_bitmask,  lookup_tree, lookup_indexed_tree, lookup_dag,
    lookup_sdag, lookup_vq2,   lookup_vq2_plus, lookup_vq4,  lookup_vq4_plus};

}  // namespace

std::span<const uint32_t> codeOf(Shader shader) {
    return lookups[static_cast<size_t>(shader.decoder)];
}

}  // namespace filigree::vulkan
