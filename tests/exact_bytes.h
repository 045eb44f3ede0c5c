// Bytes whose end a sanitizer guards.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace filigree::tests {

// Memory of exactly this size, so that a sanitizer sees the first byte read past its end.
class ExactBytes {
  public:
    explicit ExactBytes(std::span<const uint8_t> bytes)
        : bytes_(std::make_unique<uint8_t[]>(bytes.size())), size_(bytes.size()) {
        std::ranges::copy(bytes, bytes_.get());
    }
    [[nodiscard]] std::span<const uint8_t> view() const { return {bytes_.get(), size_}; }

  private:
    std::unique_ptr<uint8_t[]> bytes_;
    size_t size_;
};

}  // namespace filigree::tests
