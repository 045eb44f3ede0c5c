#include "filigree/grid/encoded_grids.h"

namespace filigree::grid {

std::string_view nameOf(Codec codec) {
    return codec == Codec::paper ? "paper" : "lattice";
}

std::optional<Codec> codecNamed(std::string_view name) {
    for (const Codec codec : {Codec::paper, Codec::lattice}) {
        if (nameOf(codec) == name) return codec;
    }
    return std::nullopt;
}

}  // namespace filigree::grid
