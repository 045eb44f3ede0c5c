// Fields of a section one after another, in and out.
#pragma once

#include "filigree/core/bytes.h"
#include "filigree/core/result.h"

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace filigree::io {

// Appends little-endian fields, numbers as the bits of doubles, texts as a u32 of their bytes and those.
class ByteWriter {
  public:
    template <class T>
    void put(T value) {
        bytes_.resize(bytes_.size() + sizeof(T));
        storeLe(bytes_.data() + bytes_.size() - sizeof(T), value);
    }
    void put(double value) { put(std::bit_cast<uint64_t>(value)); }
    void put(const std::string& text) {
        put(static_cast<uint32_t>(text.size()));
        bytes_.insert(bytes_.end(), text.begin(), text.end());
    }
    std::vector<uint8_t> take() && { return std::move(bytes_); }

  private:
    std::vector<uint8_t> bytes_;
};

// Reads one field after another. The first that is short or out of range makes the error; all after it read
// as 0.
class ByteReader {
  public:
    explicit ByteReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    template <class T>
    T take(const char* what) {
        return has(sizeof(T), what) ? loadLe<T>(advance(sizeof(T))) : T{};
    }
    template <class T>
    T take(const char* what, uint64_t least, uint64_t most) {
        const size_t at = at_;
        const T value = take<T>(what);
        if (status_ && (value < least || value > most))
            fail(at, fmt::format("{} is {}, expected {} to {}", what, value, least, most));
        return value;
    }
    double takeNumber(const char* what, double most) {
        const size_t at = at_;
        const auto value = std::bit_cast<double>(take<uint64_t>(what));
        if (status_ && !(value >= 0 && value <= most))
            fail(at, fmt::format("{} is {}, expected 0 to {}", what, value, most));
        return value;
    }
    std::string takeText(const char* what) {
        const auto size = take<uint32_t>(what);
        if (!has(size, what)) return {};
        const uint8_t* const from = advance(size);
        return {from, from + size};
    }
    // A count of things that take at least `bytes` bytes each.
    uint32_t takeCount(const char* what, size_t bytes) {
        const size_t at = at_;
        const auto count = take<uint32_t>(what);
        if (status_ && count > (bytes_.size() - at_) / bytes) {
            fail(at,
                 fmt::format("{} {}, more than the {} bytes left hold", count, what, bytes_.size() - at_));
        }
        return status_ ? count : 0;
    }
    void expectEnd() {
        if (status_ && at_ != bytes_.size()) fail(at_, fmt::format("{} bytes too many", bytes_.size() - at_));
    }
    void fail(size_t at, const std::string& message) {
        if (status_) status_ = Error{ErrorKind::format, fmt::format("byte {}: {}", at, message)};
    }
    [[nodiscard]] size_t position() const { return at_; }
    [[nodiscard]] const Status& status() const { return status_; }

  private:
    bool has(size_t bytes, const char* what) {
        if (status_ && bytes_.size() - at_ < bytes)
            fail(at_, fmt::format("ends inside {}, {} bytes left", what, bytes_.size() - at_));
        return status_.ok();
    }
    const uint8_t* advance(size_t bytes) { return bytes_.data() + std::exchange(at_, at_ + bytes); }

    std::span<const uint8_t> bytes_;
    size_t at_ = 0;
    Status status_;
};

}  // namespace filigree::io
