#include "io/fil_sections.h"

#include "io/zstd_bytes.h"

#include <algorithm>

namespace filigree::io {
namespace {

// The `bits` <= 32 bits from bit `at` of `bytes` on, which hold them.
uint64_t bitsAt(std::span<const uint8_t> bytes, uint64_t at, unsigned bits) {
    uint64_t value = 0;
    const uint64_t last = (at + bits - 1) / 8;
    for (uint64_t byte = last + 1; byte-- > at / 8;) value = value << 8 | bytes[byte];
    return value >> (at % 8) & ((uint64_t{1} << bits) - 1);
}

}  // namespace

const FilSection* FilSections::find(FilKind kind) const {
    const auto found = std::ranges::find(sections_, static_cast<uint32_t>(kind), &FilSection::kind);
    return found == sections_.end() ? nullptr : &*found;
}

Status FilSections::allowOnly(std::initializer_list<FilKind> kinds) const {
    for (const FilSection& section : sections_) {
        if (std::ranges::find(kinds, static_cast<FilKind>(section.kind)) != kinds.end()) continue;
        return Error{ErrorKind::format,
                     fmt::format("section {}: does not belong here", filKindName(section.kind))};
    }
    return {};
}

Result<std::span<const uint8_t>> FilSections::take(FilKind kind, uint64_t least, uint64_t most) {
    const std::string name = "section " + filKindName(static_cast<uint32_t>(kind));
    const FilSection* const section = find(kind);
    if (section == nullptr) return Error{ErrorKind::format, name + ": is missing"};
    if (section->plainBytes < least || section->plainBytes > most) {
        return Error{ErrorKind::format,
                     fmt::format("{}: {} bytes, expected {}", name, section->plainBytes,
                                 least == most ? std::to_string(most) : fmt::format("at most {}", most))};
    }
    if (!section->zstd) return section->stored;
    if (section->plainBytes > left_) {
        return Error{ErrorKind::limit, fmt::format("{}: {} bytes when plain, more than the {} allowed", name,
                                                   section->plainBytes, left_)};
    }
    left_ -= section->plainBytes;
    auto plain = zstdDecompress(section->stored, section->plainBytes);
    if (!plain) return plain.error().within(name);
    return std::span<const uint8_t>(plain_.emplace_back(std::move(*plain)));
}

Status checkFilIndices(std::span<const uint8_t> indices, unsigned bits, uint64_t triangles,
                       uint32_t mapCount) {
    if (bits == 0) return {};
    for (uint64_t t = 0; t < triangles; ++t) {
        const uint64_t code = bitsAt(indices, t * bits, bits);
        if (code < uint64_t{mapCount} + filSpecials) continue;
        return Error{ErrorKind::format, fmt::format("section indices: triangle {} has map {} of {}", t,
                                                    code - filSpecials, mapCount)};
    }
    const auto used = static_cast<unsigned>(triangles * bits % 8);
    if (used != 0 && indices.back() >> used != 0)
        return Error{ErrorKind::format, "section indices: spare bits of the last byte are not zero"};
    return {};
}

void readFilIndices(std::span<const uint8_t> indices, unsigned bits, uint64_t first, std::span<int32_t> to) {
    for (size_t k = 0; k < to.size(); ++k) {
        const auto code = static_cast<int64_t>(bitsAt(indices, (first + k) * bits, bits));
        to[k] = static_cast<int32_t>(code < filSpecials ? -1 - code : code - filSpecials);
    }
}

}  // namespace filigree::io
