#include "io/ply_values.h"

#include "filigree/core/bytes.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

namespace filigree::io {
namespace {

constexpr const char* fileEnds = "the file ends";

uint64_t loadPly(const uint8_t* from, size_t size, bool bigEndian) {
    uint64_t bits = 0;
    for (size_t k = 0; k < size; ++k) bits |= uint64_t{from[bigEndian ? size - 1 - k : k]} << (8 * k);
    return bits;
}

double plyNumber(uint64_t bits, PlyType type) {
    switch (type) {
        case PlyType::int8:
            return static_cast<int8_t>(bits);
        case PlyType::int16:
            return static_cast<int16_t>(bits);
        case PlyType::int32:
            return static_cast<int32_t>(bits);
        case PlyType::float32:
            return std::bit_cast<float>(static_cast<uint32_t>(bits));
        case PlyType::float64:
            return std::bit_cast<double>(bits);
        default:
            return static_cast<double>(bits);
    }
}

bool isBlank(uint8_t c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

}  // namespace

void PlyValues::passBlanks() {
    const auto word = std::ranges::find_if_not(left_, isBlank);
    left_ = left_.subspan(static_cast<size_t>(word - left_.begin()));
}

bool PlyValues::takeText(PlyType type, double& value) {
    passBlanks();
    if (left_.empty()) return fail(fileEnds);
    const auto wordEnd = std::ranges::find_if(left_, isBlank);
    const auto length = static_cast<size_t>(wordEnd - left_.begin());
    const auto* first = reinterpret_cast<const char*>(left_.data());
    const auto* last = first + length;
    left_ = left_.subspan(length);
    if (*first == '+') ++first;
    float single = 0;
    const auto [end, error] =
        type == PlyType::float32 ? std::from_chars(first, last, single) : std::from_chars(first, last, value);
    if (type == PlyType::float32) value = single;
    if (error != std::errc{} || end != last) return fail("a word that is no number of its type");
    return true;
}

bool PlyValues::take(PlyType type, double& value) {
    if (format_ == PlyFormat::ascii) return takeText(type, value);
    const size_t size = sizeOf(type);
    if (left_.size() < size) return fail(fileEnds);
    value = plyNumber(loadPly(left_.data(), size, format_ == PlyFormat::bigEndian), type);
    left_ = left_.subspan(size);
    return true;
}

bool PlyValues::takeCount(const PlyProperty& list, uint64_t& count) {
    double value = 0;
    if (!take(*list.countType, value)) return false;
    if (!(value >= 0) || value != std::floor(value) || value > 0x1p32)
        return fail("a list of no proper length");
    count = static_cast<uint64_t>(value);
    if (!canHold(count, format_ == PlyFormat::ascii ? 2 : sizeOf(list.type))) return fail(fileEnds);
    return true;
}

bool PlyValues::skip(const PlyProperty& property) {
    uint64_t count = 1;
    if (property.countType && !takeCount(property, count)) return false;
    double ignored = 0;
    for (uint64_t k = 0; k < count; ++k) {
        if (!take(property.type, ignored)) return false;
    }
    return true;
}

bool PlyValues::atEnd() {
    if (format_ == PlyFormat::ascii) passBlanks();
    return left_.empty();
}

}  // namespace filigree::io
