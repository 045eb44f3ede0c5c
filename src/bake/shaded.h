// Triangles whose vertices differ in alpha: the product of two varying factors has no outline to trace, so it
// is bounded part by part.
#pragma once

#include "filigree/image/extremes.h"
#include "filigree/image/mip_chain.h"
#include "filigree/mesh/uv_triangle.h"

#include "bake/classify.h"
#include "bake/field.h"
#include "bake/placement.h"
#include "bake/tile.h"

#include <deque>
#include <vector>

namespace filigree::bake {

// A texture and its mip levels, ready to be bounded.
class ShadedField {
  public:
    ShadedField(const image::MipChain& chain, const image::AlphaTest& test);

    struct Layer {
        const image::AlphaTexture* texture;
        image::TexelExtremes extremes;
    };
    [[nodiscard]] const std::deque<Layer>& layers() const { return layers_; }
    [[nodiscard]] const image::AlphaTest& test() const { return test_; }

  private:
    std::deque<Layer> layers_;
    image::AlphaTest test_;
};

// As classify() does (classify.h), for any vertex alphas. A micro-triangle is known where the product of the
// ranges of texture alpha and vertex alpha is on one side, which may miss some that are.
void classifyShaded(const mesh::UvTriangle& triangle, const ShadedField& field, unsigned level, bool twoState,
                    Classified& to);

}  // namespace filigree::bake
