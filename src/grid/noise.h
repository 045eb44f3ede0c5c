// Gradient noise of additions and multiplications alone, so that every machine gives the same bits (Perlin,
// "Improving Noise", 2002).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace filigree::grid {

template <size_t dimensions>
using NoisePoint = std::array<double, dimensions>;

// SplitMix64's finaliser (Steele, Lea, Flood 2014).
constexpr uint64_t mixedBits(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
}

// The slope at a lattice point, each component in [-1, 1), times the way from it.
template <size_t dimensions>
double slopeAt(const std::array<int64_t, dimensions>& cell, const NoisePoint<dimensions>& way,
               uint64_t seed) {
    uint64_t bits = seed;
    for (const int64_t c : cell) bits = bits * 0x9E3779B97F4A7C15U + static_cast<uint64_t>(c);
    bits = mixedBits(bits);
    double sum = 0;
    for (size_t k = 0; k < dimensions; ++k) {
        const auto component = static_cast<int64_t>((bits >> (20 * k)) & 0xfffff) - 0x80000;
        sum += static_cast<double>(component) * 0x1p-19 * way[k];
    }
    return sum;
}

// About [-0.7, 0.7], with two continuous derivatives.
template <size_t dimensions>
double gradientNoise(const NoisePoint<dimensions>& at, uint64_t seed) {
    std::array<int64_t, dimensions> cell{};
    NoisePoint<dimensions> inside{};
    NoisePoint<dimensions> fade{};
    for (size_t k = 0; k < dimensions; ++k) {
        const double below = std::floor(at[k]);
        cell[k] = static_cast<int64_t>(below);
        const double f = inside[k] = at[k] - below;
        fade[k] = f * f * f * (f * (f * 6 - 15) + 10);
    }
    std::array<double, size_t{1} << dimensions> values{};
    for (size_t corner = 0; corner < values.size(); ++corner) {
        auto c = cell;
        auto way = inside;
        for (size_t k = 0; k < dimensions; ++k) {
            if ((corner >> k & 1) == 0) continue;
            c[k] += 1;
            way[k] -= 1;
        }
        values[corner] = slopeAt<dimensions>(c, way, seed);
    }
    for (size_t k = dimensions, half = values.size() / 2; half > 0; half /= 2) {
        --k;
        for (size_t i = 0; i < half; ++i) values[i] += fade[k] * (values[i + half] - values[i]);
    }
    return values[0];
}

// Octaves of noise, the first at frequency `frequency`, each of twice the frequency and `gain` times the
// height of the one before.
template <size_t dimensions>
double fractalNoise(NoisePoint<dimensions> at, double frequency, unsigned octaves, double gain,
                    uint64_t seed) {
    double sum = 0;
    double height = 1;
    for (double& x : at) x *= frequency;
    for (unsigned octave = 0; octave < octaves; ++octave) {
        sum += height * gradientNoise<dimensions>(at, seed + octave);
        height *= gain;
        for (double& x : at) x = 2 * x + 0.37;  // off the lattice, where noise is zero
    }
    return sum;
}

// The same of ridges: 1 - |noise|, the ridge's crest rounded over a height of `crest`.
template <size_t dimensions>
double ridgedNoise(NoisePoint<dimensions> at, double frequency, unsigned octaves, double gain, double crest,
                   uint64_t seed) {
    double sum = 0;
    double height = 1;
    for (double& x : at) x *= frequency;
    for (unsigned octave = 0; octave < octaves; ++octave) {
        const double noise = gradientNoise<dimensions>(at, seed + octave);
        const double ridge = 1 - std::sqrt(noise * noise + crest * crest);
        sum += height * ridge * ridge;
        height *= gain;
        for (double& x : at) x = 2 * x + 0.37;
    }
    return sum;
}

}  // namespace filigree::grid
