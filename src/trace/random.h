// Random numbers as functions of where they are used, so that no order of work changes them.
#pragma once

#include <cstdint>

namespace filigree::trace {

// Mixes 32 bits well (the finaliser "lowbias32" of Wellons' hash prospector, 2018).
constexpr uint32_t hashed(uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}
constexpr uint32_t hashed(uint32_t a, uint32_t b) {
    return hashed(a + 0x9e3779b9u * (hashed(b) | 1));
}

// In [0, 1), in steps of 2^-24.
constexpr float unitFloat(uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

// A stream of numbers for one sample of one pixel.
class RandomStream {
  public:
    RandomStream(uint32_t seed, uint32_t pixel, uint32_t sample)
        : key_(hashed(seed, hashed(pixel, sample))) {}
    float next() { return unitFloat(bits()); }
    uint32_t bits() { return hashed(key_, count_++); }

  private:
    uint32_t key_;
    uint32_t count_ = 0;
};

}  // namespace filigree::trace
