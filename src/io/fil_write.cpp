#include "io/fil_write.h"

#include "filigree/core/bytes.h"
#include "filigree/core/file.h"
#include "filigree/io/fil.h"
#include "filigree/io/fil_squares.h"

#include "io/fil_layout.h"
#include "io/fil_meta.h"
#include "io/zstd_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include <fmt/format.h>
#include <xxhash.h>

namespace filigree::io {
namespace {

std::vector<uint8_t> packIndices(std::span<const int32_t> indices, unsigned bits) {
    std::vector<uint8_t> bytes((indices.size() * bits + 7) / 8);
    uint64_t waiting = 0;
    unsigned count = 0;
    size_t at = 0;
    for (const int32_t index : indices) {
        const uint64_t code = index < 0 ? static_cast<uint64_t>(-1 - index) : uint64_t(index) + filSpecials;
        assert(code >> bits == 0);
        waiting |= code << count;
        for (count += bits; count >= 8; count -= 8, waiting >>= 8)
            bytes[at++] = static_cast<uint8_t>(waiting);
    }
    if (count > 0) bytes[at] = static_cast<uint8_t>(waiting);
    return bytes;
}

Status checkIndices(std::span<const int32_t> indices, uint32_t mapCount) {
    const auto legal = [&](int32_t index) { return index >= -4 && index < int64_t{mapCount}; };
    const auto wrong = std::ranges::find_if_not(indices, legal);
    if (wrong == indices.end()) return {};
    return Error{ErrorKind::usage, fmt::format("triangle {}: index {}, expected -4 to {}",
                                               wrong - indices.begin(), *wrong, int64_t{mapCount} - 1)};
}

// Half a byte a triangle, the first of each byte in its low half.
std::vector<uint8_t> packPlaces(std::span<const quadmap::SquarePlace> places) {
    std::vector<uint8_t> bytes((places.size() + 1) / 2);
    for (size_t k = 0; k < places.size(); ++k)
        bytes[k / 2] |= static_cast<uint8_t>(codeOf(places[k]) << (4 * (k % 2)));
    return bytes;
}

Error wrongCount(std::string_view what, uint64_t found, uint64_t expected) {
    return {ErrorKind::usage, fmt::format("{} {}, expected {}", found, what, expected)};
}

Result<FilSectionList> sectionsOf(const FilContents& contents) {
    const encoding::EncodedView& set = contents.set;
    if (set.mapCount > INT32_MAX) return wrongCount("micromaps", set.mapCount, INT32_MAX);
    const uint64_t triangles =
        set.encoding == encoding::Encoding::bitmask ? 0 : contents.meta.triangleCount();
    if (contents.indices.size() != triangles)
        return wrongCount("micromap indices", contents.indices.size(), triangles);
    if (const uint64_t bytes = (uint64_t{set.mapCount} + 3) / 4;
        !contents.pairs.empty() && contents.pairs.size() != bytes)
        return wrongCount("bytes of pairs", contents.pairs.size(), bytes);
    if (const Status status = checkIndices(contents.indices, set.mapCount); !status) return status.error();
    FilSectionList sections;
    sections.add(FilKind::meta, encodeMeta({contents.meta, set.encoding, set.format, set.mapCount, {}}));
    sections.add(FilKind::indices, packIndices(contents.indices, filIndexBits(set.encoding, set.mapCount)));
    sections.view(FilKind::descriptors, set.descriptors);
    sections.view(FilKind::payload, set.payload);
    if (!contents.pairs.empty()) sections.view(FilKind::pairs, contents.pairs);
    return sections;
}

Result<FilSectionList> sectionsOf(const FilSquares& squares) {
    const uint64_t triangles = squares.meta.triangleCount();
    const size_t blockBytes = blockBytesOf(squares.format);
    if (squares.indices.size() != triangles) return wrongCount("indices", squares.indices.size(), triangles);
    if (squares.places.size() != triangles) return wrongCount("places", squares.places.size(), triangles);
    if (squares.blocks.size() % blockBytes != 0 || squares.blocks.size() / blockBytes > INT32_MAX)
        return Error{ErrorKind::usage, fmt::format("{} bytes of maps, expected a multiple of {}, and below "
                                                   "2^31 maps",
                                                   squares.blocks.size(), blockBytes)};
    const auto mapCount = static_cast<uint32_t>(squares.blocks.size() / blockBytes);
    if (const Status status = checkIndices(squares.indices, mapCount); !status) return status.error();
    FilHead head{squares.meta, {}, micromap::Format::fourState, mapCount, squares.format};
    head.meta.level.reset();
    FilSectionList sections;
    sections.add(FilKind::meta, encodeMeta(head));
    sections.add(FilKind::indices, packIndices(squares.indices, filIndexBits(head.encoding, mapCount)));
    sections.add(FilKind::descriptors, packPlaces(squares.places));
    sections.view(FilKind::payload, squares.blocks);
    return sections;
}

}  // namespace

void FilSectionList::add(FilKind kind, std::vector<uint8_t> bytes) {
    // The bytes stay where they are when the list of lists grows.
    view(kind, owned_.emplace_back(std::move(bytes)));
}

void FilSectionList::compress() {
    for (Section& section : sections_) {
        std::vector<uint8_t> frame = zstdCompress(section.plain);
        if (frame.size() < section.plain.size()) section.frame = std::move(frame);
    }
}

std::vector<uint8_t> FilSectionList::table() const {
    const size_t hashed = filHeaderBytes + sections_.size() * filEntryBytes;
    std::vector<uint8_t> bytes(hashed + filHashBytes);
    uint64_t end = bytes.size();
    uint8_t* entry = bytes.data() + filHeaderBytes;
    for (const Section& section : sections_) {
        const auto stored = section.stored();
        const uint64_t offset = filAligned(end);
        storeLe(entry, static_cast<uint32_t>(section.kind));
        storeLe(entry + 4, section.frame.empty() ? 0 : filZstd);
        storeLe(entry + 8, offset);
        storeLe(entry + 16, uint64_t{stored.size()});
        storeLe(entry + 24, uint64_t{section.plain.size()});
        storeLe(entry + 32, uint64_t{XXH3_64bits(stored.data(), stored.size())});
        entry += filEntryBytes;
        end = offset + stored.size();
    }
    std::copy(filMagic.begin(), filMagic.end(), bytes.begin());
    storeLe(bytes.data() + 8, filVersion);
    storeLe(bytes.data() + 12, static_cast<uint32_t>(sections_.size()));
    storeLe(bytes.data() + 16, end);
    storeLe(bytes.data() + hashed, uint64_t{XXH3_64bits(bytes.data(), hashed)});
    return bytes;
}

std::vector<std::span<const uint8_t>> FilSectionList::pieces(std::span<const uint8_t> table) const {
    static constexpr std::array<uint8_t, filAlignment> zeros{};
    std::vector<std::span<const uint8_t>> pieces{table};
    uint64_t end = table.size();
    for (const Section& section : sections_) {
        pieces.push_back(std::span(zeros).first(filAligned(end) - end));
        pieces.push_back(section.stored());
        end = filAligned(end) + section.stored().size();
    }
    return pieces;
}

Result<uint64_t> FilSectionList::write(const std::filesystem::path& path, bool zstd) && {
    if (zstd) compress();
    const std::vector<uint8_t> begin = table();
    const auto all = pieces(begin);
    if (const Status status = writeFile(path, all); !status) return status.error();
    uint64_t bytes = 0;
    for (const auto piece : all) bytes += piece.size();
    return bytes;
}

std::vector<uint8_t> FilSectionList::join(bool zstd) && {
    if (zstd) compress();
    const std::vector<uint8_t> begin = table();
    std::vector<uint8_t> bytes;
    for (const auto piece : pieces(begin)) bytes.insert(bytes.end(), piece.begin(), piece.end());
    return bytes;
}

unsigned filIndexBits(encoding::Encoding encoding, uint32_t mapCount) {
    if (encoding == encoding::Encoding::bitmask) return 0;
    return static_cast<unsigned>(std::bit_width(uint64_t{mapCount} + filSpecials - 1));
}

uint64_t filIndexBytes(encoding::Encoding encoding, uint32_t mapCount, uint64_t triangles) {
    return (triangles * filIndexBits(encoding, mapCount) + 7) / 8;
}

Result<uint64_t> writeFil(const std::filesystem::path& path, const FilContents& contents, bool zstd) {
    Result<FilSectionList> sections = sectionsOf(contents);
    if (!sections) return sections.error().within(path.string());
    return std::move(*sections).write(path, zstd);
}

Result<std::vector<uint8_t>> encodeFil(const FilContents& contents, bool zstd) {
    Result<FilSectionList> sections = sectionsOf(contents);
    if (!sections) return sections.error();
    return std::move(*sections).join(zstd);
}

Result<uint64_t> writeFilSquares(const std::filesystem::path& path, const FilSquares& squares, bool zstd) {
    Result<FilSectionList> sections = sectionsOf(squares);
    if (!sections) return sections.error().within(path.string());
    return std::move(*sections).write(path, zstd);
}

Result<std::vector<uint8_t>> encodeFilSquares(const FilSquares& squares, bool zstd) {
    Result<FilSectionList> sections = sectionsOf(squares);
    if (!sections) return sections.error();
    return std::move(*sections).join(zstd);
}

}  // namespace filigree::io
