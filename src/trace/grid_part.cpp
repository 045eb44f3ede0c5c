#include "filigree/trace/grid_part.h"

#include "filigree/bvh/node.h"

namespace filigree::trace {

Box boundsOf(const GridPart& part) {
    Box box;
    if (part.grids == nullptr || part.grids->nodes.empty()) return box;
    const bvh::Node& root = part.grids->nodes.front();
    for (size_t k = 0; k < bvh::width; ++k) {
        if (root.hasChild(k)) box.extend(root.childBox(k));
    }
    if (part.grids->codec == grid::Codec::paper) return box;
    const grid::Lattice& lattice = part.grids->lattice;
    const auto toWorld = [&](const Vec3& p) {
        Vec3 at{};
        for (size_t k = 0; k < 3; ++k)
            at[k] = static_cast<float>(lattice.origin[k] + lattice.step[k] * double{p[k]});
        return at;
    };
    return {toWorld(box.low), toWorld(box.high)};
}

}  // namespace filigree::trace
