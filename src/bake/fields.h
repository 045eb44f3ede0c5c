// The fields that a mesh needs: one for each vertex alpha that is constant over a triangle, one for the rest.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/image/mip_chain.h"
#include "filigree/mesh/uv_triangle.h"

#include "bake/classify.h"
#include "bake/field.h"
#include "bake/shaded.h"

#include <map>
#include <optional>
#include <span>

namespace filigree::bake {

class Fields {
  public:
    // Ready for `triangles`. `texture` must outlive the fields.
    Fields(const image::AlphaTexture& texture, const image::AlphaTest& test,
           std::span<const mesh::UvTriangle> triangles);

    // False where a coordinate or vertex alpha is not finite or out of reach (placement.h).
    [[nodiscard]] bool canPlace(const mesh::UvTriangle& triangle) const;

    // Appends the quadtree of one of the triangles; one that cannot be placed (placement.h) is
    // unknown-opaque.
    void classify(const mesh::UvTriangle& triangle, unsigned level, bool twoState, const Executor& executor,
                  Classified& to) const;

  private:
    // More vertex alphas than this are bounded instead of traced: each outline costs as much as the texture.
    static constexpr size_t mostFields = 16;

    image::MipChain chain_;
    std::map<float, Field> constant_;
    std::optional<ShadedField> shaded_;
};

}  // namespace filigree::bake
