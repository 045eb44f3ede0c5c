// Vertex indices of 1, 2 or 4 bytes in the caller's memory.
#pragma once

#include "capi/arguments.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace filigree::capi {

class Indices {
  public:
    Indices() = default;
    Indices(const void* values, uint32_t bytes, size_t count, std::string_view name)
        : values_(static_cast<const unsigned char*>(values)), bytes_(bytes) {
        if (count > 0) required(values_, name);
        if (bytes != 1 && bytes != 2 && bytes != 4)
            fail(FILIGREE_ERROR_ARGUMENT, "index_bytes: is {}, expected 1, 2 or 4", bytes);
    }

    uint32_t operator[](size_t k) const {
        if (bytes_ == 1) return values_[k];
        return bytes_ == 2 ? load<uint16_t>(k) : load<uint32_t>(k);
    }

    // Of the type.
    [[nodiscard]] uint32_t greatest() const { return UINT32_MAX >> (32 - 8 * bytes_); }

  private:
    template <class T>
    [[nodiscard]] T load(size_t k) const {
        T value;
        std::memcpy(&value, values_ + k * sizeof(T), sizeof value);
        return value;
    }

    const unsigned char* values_ = nullptr;
    uint32_t bytes_ = 4;
};

}  // namespace filigree::capi
