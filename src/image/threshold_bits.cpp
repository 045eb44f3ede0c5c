#include "image/threshold_bits.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "image/threshold_bits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::image::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// `lowest` <= 65535.
void thresholdBitsSimd(const uint16_t* texels, size_t count, uint16_t lowest, uint64_t* bits) {
    const hn::CappedTag<uint16_t, 64> d;
    const auto threshold = hn::Set(d, lowest);
    const size_t lanes = hn::Lanes(d);
    for (size_t word = 0; word < count / 64; ++word) {
        uint64_t all = 0;
        for (size_t k = 0; k < 64; k += lanes) {
            // Highway lacks an unsigned 16-bit comparison on old targets; a maximum that changes nothing
            // serves.
            const auto texel = hn::LoadU(d, texels + 64 * word + k);
            uint8_t mask[8] = {};
            hn::StoreMaskBits(d, hn::Eq(hn::Max(texel, threshold), texel), mask);
            uint64_t part = 0;
            std::memcpy(&part, mask, sizeof(part));
            all |= part << k;
        }
        bits[word] = all;
    }
    for (size_t k = count / 64 * 64; k < count; ++k) {
        if (k % 64 == 0) bits[k / 64] = 0;
        bits[k / 64] |= uint64_t{texels[k] >= lowest} << (k % 64);
    }
}

}  // namespace filigree::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::image {

HWY_EXPORT(thresholdBitsSimd);

void thresholdBits(const uint16_t* texels, size_t count, uint32_t lowest, uint64_t* bits) {
    if (lowest > 65535) {
        std::fill_n(bits, (count + 63) / 64, uint64_t{0});
        return;
    }
    HWY_DYNAMIC_DISPATCH(thresholdBitsSimd)(texels, count, static_cast<uint16_t>(lowest), bits);
}

}  // namespace filigree::image
#endif
