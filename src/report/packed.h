// Bytes as text that a page's script unpacks.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace filigree::report {

// A zlib stream in base64.
std::string packed(std::span<const uint8_t> bytes);

// Columns of 32-bit numbers, each stored as four planes of bytes: small numbers leave planes of zeros.
class ColumnWriter {
  public:
    // value(k) for each of `count` rows.
    template <class Value>
    void column(size_t count, Value&& value) {
        const size_t from = bytes_.size();
        bytes_.resize(from + 4 * count);
        for (size_t k = 0; k < count; ++k) {
            const uint32_t number = value(k);
            for (size_t plane = 0; plane < 4; ++plane)
                bytes_[from + plane * count + k] = static_cast<uint8_t>(number >> (8 * plane));
        }
    }
    void append(std::span<const uint8_t> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
    [[nodiscard]] const std::vector<uint8_t>& bytes() const { return bytes_; }

  private:
    std::vector<uint8_t> bytes_;
};

}  // namespace filigree::report
