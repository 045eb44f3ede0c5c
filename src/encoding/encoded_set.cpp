#include "filigree/encoding/encoded_set.h"

#include <array>

namespace filigree::encoding {
namespace {

constexpr std::array<std::string_view, encodingCount> names{"flat",         "gruen", "bitmask", "tree",
                                                            "indexed-tree", "dag",   "sdag"};

}  // namespace

std::string_view nameOf(Encoding encoding) {
    return names[static_cast<size_t>(encoding)];
}

std::optional<Encoding> encodingNamed(std::string_view name) {
    for (size_t k = 0; k < names.size(); ++k) {
        if (names[k] == name) return static_cast<Encoding>(k);
    }
    return std::nullopt;
}

}  // namespace filigree::encoding
