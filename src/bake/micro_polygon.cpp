#include "bake/micro_polygon.h"

#include <algorithm>

namespace filigree::bake {

WidenedShape::WidenedShape(const std::array<Point<double>, 3>& corners, double guard) {
    const auto shape = image::widened(corners, guard);
    size_ = shape.size();
    std::ranges::copy(shape, shape_.begin());
}

}  // namespace filigree::bake
