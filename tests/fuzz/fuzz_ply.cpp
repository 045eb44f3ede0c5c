// Any bytes as a PLY file. What is read can be made into grids.
#include "filigree/grid/convert.h"
#include "filigree/io/ply.h"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace filigree;
    const auto mesh = io::parsePly({data, size});
    if (!mesh) return 0;
    const auto grids = grid::gridsOf(*mesh, {}, serialExecutor());
    if (!grids.ok() || grids->triangleCount() != mesh->triangleCount()) {
        std::fputs("a mesh that was read does not convert\n", stderr);
        std::abort();
    }
    return 0;
}
