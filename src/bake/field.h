// What a triangle is baked against: every outline that its known micro-triangles must keep clear of.
#pragma once

#include "filigree/image/alpha_image.h"
#include "filigree/image/outline.h"

#include <memory>
#include <vector>

namespace filigree::bake {

// One outline: a mip level under one filter and one threshold.
struct Layer {
    image::Outline outline;
};

// The texture under one vertex alpha. A micro-triangle is known when it keeps clear of the outlines of all
// layers and lies on the same side of each (docs/spec/bake.md).
class Field {
  public:
    // Mip levels are those of `chain`, level 0 first; its textures must outlive the field.
    Field(const std::vector<const image::AlphaTexture*>& chain, const image::AlphaTest& test,
          double vertexAlpha);

    [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
    [[nodiscard]] double guard() const { return guard_; }

    // The outline at level 0 that tells which side of an unknown micro-triangle is the greater. Often
    // layers()[0].
    [[nodiscard]] const image::Outline& sideOutline() const {
        return sideOutline_ ? *sideOutline_ : layers_.front().outline;
    }

    // True when no layer has an outline.
    [[nodiscard]] bool empty() const;

  private:
    std::vector<Layer> layers_;
    std::unique_ptr<image::Outline> sideOutline_;
    double guard_;
};

}  // namespace filigree::bake
