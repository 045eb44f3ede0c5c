// What an encoded set of micromaps is and takes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace filigree::jobs {

struct EncodedSize {
    std::string encoding;
    std::optional<unsigned> level;  // of all maps; none where they differ: "auto"
    unsigned states = 4;
    uint64_t maps = 0;
    uint64_t payloadBytes = 0;
    uint64_t descriptorBytes = 0;
};

}  // namespace filigree::jobs
