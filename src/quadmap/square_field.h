// A texture and an alpha test, ready to fill the halves of squares.
#pragma once

#include "filigree/image/alpha_sides.h"
#include "filigree/image/mip_chain.h"
#include "filigree/quadmap/place.h"
#include "filigree/quadmap/square.h"

#include <array>
#include <deque>
#include <vector>

namespace filigree::quadmap {

// A triangle on a texture: vertex k stands at the texture coordinates x[k] / width, y[k] / height.
struct HalfShape {
    std::array<double, 3> x{};
    std::array<double, 3> y{};
    double width = 1;
    double height = 1;
    std::array<double, 3> alpha{1, 1, 1};  // >= 0
};

// What two parts of a region make of it. A free part does not count.
constexpr Region agreed(Region a, Region b) {
    if (a == Region::free) return b;
    return b == Region::free || a == b ? a : Region::mixed;
}

class SquareField {
  public:
    SquareField(const image::AlphaTexture& texture, const image::AlphaTest& test);

    // Adds to `square` what is known of the regions that the half reaches.
    void fill(const HalfShape& shape, Half half, Square& square) const;

    // A mip level.
    struct Layer {
        image::AlphaSides sides;
        std::vector<image::Filter> filters;
    };
    [[nodiscard]] const std::deque<Layer>& layers() const { return layers_; }
    [[nodiscard]] const image::AlphaTest& test() const { return test_; }
    [[nodiscard]] const image::AlphaTexture& texture() const { return *chain_.levels().front(); }

  private:
    image::MipChain chain_;
    std::deque<Layer> layers_;
    image::AlphaTest test_;
};

}  // namespace filigree::quadmap
