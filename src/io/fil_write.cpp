#include "io/fil_write.h"

#include "filigree/core/bytes.h"
#include "filigree/core/file.h"
#include "filigree/io/fil.h"
#include "filigree/io/fil_squares.h"

#include "io/fil_layout.h"
#include "io/fil_meta.h"
#include "io/zstd_bytes.h"

#include <bit>
#include <cassert>

#include <xxhash.h>

namespace filigree::io {
namespace {

void compress(FilSectionOut& section) {
    std::vector<uint8_t> frame = zstdCompress(section.plain);
    if (frame.size() < section.plain.size()) section.frame = std::move(frame);
}

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

// Half a byte a triangle, the first of each byte in its low half.
std::vector<uint8_t> packPlaces(std::span<const quadmap::SquarePlace> places) {
    std::vector<uint8_t> bytes((places.size() + 1) / 2);
    for (size_t k = 0; k < places.size(); ++k)
        bytes[k / 2] |= static_cast<uint8_t>(codeOf(places[k]) << (4 * (k % 2)));
    return bytes;
}

// Header, table and their hash.
std::vector<uint8_t> tableOf(const std::vector<FilSectionOut>& sections) {
    const size_t hashed = filHeaderBytes + sections.size() * filEntryBytes;
    std::vector<uint8_t> bytes(hashed + filHashBytes);
    uint64_t end = bytes.size();
    uint8_t* entry = bytes.data() + filHeaderBytes;
    for (const FilSectionOut& section : sections) {
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
    storeLe(bytes.data() + 12, static_cast<uint32_t>(sections.size()));
    storeLe(bytes.data() + 16, end);
    storeLe(bytes.data() + hashed, uint64_t{XXH3_64bits(bytes.data(), hashed)});
    return bytes;
}

}  // namespace

Result<uint64_t> writeSections(const std::filesystem::path& path, std::vector<FilSectionOut> sections,
                               bool zstd) {
    for (FilSectionOut& section : sections) {
        if (zstd) compress(section);
    }
    const std::vector<uint8_t> table = tableOf(sections);
    static constexpr std::array<uint8_t, filAlignment> zeros{};
    std::vector<std::span<const uint8_t>> pieces{table};
    uint64_t end = table.size();
    for (const FilSectionOut& section : sections) {
        pieces.push_back(std::span(zeros).first(filAligned(end) - end));
        pieces.push_back(section.stored());
        end = filAligned(end) + section.stored().size();
    }
    if (const Status status = writeFile(path, pieces); !status) return status.error();
    return end;
}

unsigned filIndexBits(encoding::Encoding encoding, uint32_t mapCount) {
    if (encoding == encoding::Encoding::bitmask) return 0;
    return static_cast<unsigned>(std::bit_width(uint64_t{mapCount} + filSpecials - 1));
}

uint64_t filIndexBytes(encoding::Encoding encoding, uint32_t mapCount, uint64_t triangles) {
    return (triangles * filIndexBits(encoding, mapCount) + 7) / 8;
}

Result<uint64_t> writeFil(const std::filesystem::path& path, const FilContents& contents, bool zstd) {
    assert(contents.set.mapCount <= INT32_MAX);
    assert(contents.indices.size() ==
           (contents.set.encoding == encoding::Encoding::bitmask ? 0 : contents.meta.triangleCount()));
    const encoding::EncodedView& set = contents.set;
    const std::vector<uint8_t> meta = encodeMeta({contents.meta, set.encoding, set.format, set.mapCount, {}});
    const auto indices = packIndices(contents.indices, filIndexBits(set.encoding, set.mapCount));
    std::vector<FilSectionOut> sections;
    sections.push_back({FilKind::meta, meta, {}});
    sections.push_back({FilKind::indices, indices, {}});
    sections.push_back({FilKind::descriptors, set.descriptors, {}});
    sections.push_back({FilKind::payload, set.payload, {}});
    if (!contents.pairs.empty()) sections.push_back({FilKind::pairs, contents.pairs, {}});
    return writeSections(path, std::move(sections), zstd);
}

Result<uint64_t> writeFilSquares(const std::filesystem::path& path, const FilSquares& squares, bool zstd) {
    assert(squares.places.size() == squares.meta.triangleCount());
    assert(squares.indices.size() == squares.meta.triangleCount());
    const auto mapCount = static_cast<uint32_t>(squares.blocks.size() / blockBytesOf(squares.format));
    FilHead head{squares.meta, {}, micromap::Format::fourState, mapCount, squares.format};
    head.meta.level.reset();
    const std::vector<uint8_t> meta = encodeMeta(head);
    const auto indices = packIndices(squares.indices, filIndexBits(head.encoding, mapCount));
    const auto places = packPlaces(squares.places);
    std::vector<FilSectionOut> sections;
    sections.push_back({FilKind::meta, meta, {}});
    sections.push_back({FilKind::indices, indices, {}});
    sections.push_back({FilKind::descriptors, places, {}});
    sections.push_back({FilKind::payload, squares.blocks, {}});
    return writeSections(path, std::move(sections), zstd);
}

}  // namespace filigree::io
