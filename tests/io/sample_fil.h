// Small .fil files, and what it takes to change them.
#pragma once

#include "filigree/core/bytes.h"
#include "filigree/io/fil.h"

#include "io/fil_layout.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <xxhash.h>

namespace filigree::tests {

// Contents with everything a file may hold. The blocks are no encoding's; they are stored as they come.
class SampleFil {
  public:
    explicit SampleFil(uint32_t maps = 6, bool withPairs = true) : descriptors_(maps * 8), payload_(1000) {
        std::iota(descriptors_.begin(), descriptors_.end(), uint8_t{7});
        for (size_t k = 0; k < payload_.size(); ++k) payload_[k] = static_cast<uint8_t>(k / 16);
        if (withPairs) pairs_.assign((maps + 3) / 4, 0x1B);
        for (int32_t k = 0; k < 21; ++k)
            indices_.push_back(k < 4 || maps == 0 ? -1 - k % 4 : k % static_cast<int32_t>(maps));
        auto& meta = contents.meta;
        meta.asset = {"leaf.glb", 1234, {0x0123456789abcdef, 0xfedcba9876543210}};
        meta.level = 5;
        image::AlphaTest test;
        test.mode = image::AlphaMode::blend;
        test.mips = 3;
        test.factor = 0.75;
        meta.groups = {{"leaf", test}, {"fern", std::nullopt}};
        meta.primitives = {{0, 0, 10, 0}, {0, 2, 0, 1}, {1, 0, 11, 1}};
        contents.set = {encoding::Encoding::dag, micromap::Format::twoState, maps, descriptors_, payload_};
        contents.indices = indices_;
        contents.pairs = pairs_;
    }
    SampleFil(const SampleFil&) = delete;
    SampleFil& operator=(const SampleFil&) = delete;

    io::FilContents contents;

  private:
    std::vector<uint8_t> descriptors_;
    std::vector<uint8_t> payload_;
    std::vector<uint8_t> pairs_;
    std::vector<int32_t> indices_;
};

// Makes the hashes right again after a change, as far as the table can be followed.
inline void resealFil(std::span<uint8_t> file) {
    if (file.size() < io::filHeaderBytes) return;
    storeLe(file.data() + 16, uint64_t{file.size()});
    const auto count = size_t{loadLe<uint32_t>(file.data() + 12)};
    const size_t hashed = io::filHeaderBytes + count * io::filEntryBytes;
    if (count > io::filMaxSections || file.size() < hashed + io::filHashBytes) return;
    for (size_t k = 0; k < count; ++k) {
        uint8_t* const entry = file.data() + io::filHeaderBytes + k * io::filEntryBytes;
        const auto offset = loadLe<uint64_t>(entry + 8);
        const auto bytes = loadLe<uint64_t>(entry + 16);
        if (offset > file.size() || bytes > file.size() - offset) continue;
        storeLe(entry + 32, uint64_t{XXH3_64bits(file.data() + offset, bytes)});
    }
    storeLe(file.data() + hashed, uint64_t{XXH3_64bits(file.data(), hashed)});
}

}  // namespace filigree::tests
