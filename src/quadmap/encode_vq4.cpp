#include "filigree/quadmap/encode.h"

#include "quadmap/vq4_paper.h"
#include "quadmap/vq4_search.h"

namespace filigree::quadmap {
namespace {

Vq4Block encode(const Square& square, Vq4Layout layout, Vq4Method method, Prefer prefer) {
    const Weights weights = weightsOf(prefer);
    const Demand4 demand = demandOf(square, layout, weights);
    const auto book = [&] {
        switch (method) {
            case Vq4Method::paper:
                return paperVq4(demand);
            case Vq4Method::fast:
                return searchVq4(demand, {2, 6, 2, 0});
            case Vq4Method::best:
                break;
        }
        return searchVq4(demand, {4, 8, 2, 600});
    }();
    return pack(mapOf(square, book, layout, weights), layout);
}

}  // namespace

Vq4Block encodeVq4(const Square& square, Vq4Method method, Prefer prefer) {
    return encode(square, Vq4Layout::vq4, method, prefer);
}

Vq4Block encodeVq4Plus(const Square& square, Vq4Method method, Prefer prefer) {
    return encode(square, Vq4Layout::vq4Plus, method, prefer);
}

}  // namespace filigree::quadmap
