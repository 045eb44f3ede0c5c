// Values made of 32-bit words, as little-endian bytes.
#pragma once

#include "filigree/core/bytes.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::io {

template <class T>
using WordsOf = std::array<uint32_t, sizeof(T) / 4>;
template <class T>
void packWords(std::span<const T> values, std::vector<uint8_t>& to) {
    size_t at = to.size();
    to.resize(at + values.size_bytes());
    for (const T& value : values) {
        for (const uint32_t word : std::bit_cast<WordsOf<T>>(value)) {
            storeLe(&to[at], word);
            at += 4;
        }
    }
}
template <class T>
std::vector<T> unpackWords(std::span<const uint8_t> bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    size_t at = 0;
    for (T& value : values) {
        WordsOf<T> words;
        for (uint32_t& word : words) {
            word = loadLe<uint32_t>(&bytes[at]);
            at += 4;
        }
        value = std::bit_cast<T>(words);
    }
    return values;
}

}  // namespace filigree::io
