#include "filigree/core/bytes.h"
#include "filigree/io/fil.h"

#include "io/fil_layout.h"
#include "io/fil_meta.h"
#include "io/fil_table.h"
#include "io/zstd_bytes.h"

#include <algorithm>
#include <cassert>
#include <fstream>

#include <xxhash.h>

namespace filigree::io {
namespace {

// The plain bytes of sections; those of compressed ones go to `plain`.
class Sections {
  public:
    Sections(std::vector<FilSection> sections, uint64_t maxBytes, std::vector<std::vector<uint8_t>>& plain)
        : sections_(std::move(sections)), left_(maxBytes), plain_(plain) {}

    [[nodiscard]] bool has(FilKind kind) const { return find(kind) != nullptr; }

    // The section must have between `least` and `most` bytes when plain.
    Result<std::span<const uint8_t>> take(FilKind kind, uint64_t least, uint64_t most) {
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
            return Error{ErrorKind::limit, fmt::format("{}: {} bytes when plain, more than the {} allowed",
                                                       name, section->plainBytes, left_)};
        }
        left_ -= section->plainBytes;
        auto plain = zstdDecompress(section->stored, section->plainBytes);
        if (!plain) return plain.error().within(name);
        return std::span<const uint8_t>(plain_.emplace_back(std::move(*plain)));
    }

  private:
    [[nodiscard]] const FilSection* find(FilKind kind) const {
        const auto found = std::ranges::find(sections_, static_cast<uint32_t>(kind), &FilSection::kind);
        return found == sections_.end() ? nullptr : &*found;
    }

    std::vector<FilSection> sections_;
    uint64_t left_;
    std::vector<std::vector<uint8_t>>& plain_;
};

// The most bytes that the blocks of a set can need: far above what any encoding takes, yet in step with what
// the file claims to hold.
uint64_t mostDescriptorBytes(const FilHead& head) {
    return filMostDescriptorBytes * (uint64_t{head.mapCount} + 1);
}
uint64_t mostPayloadBytes(const FilHead& head) {
    if (head.encoding == encoding::Encoding::bitmask) return UINT32_MAX;
    const uint64_t flat =
        micromap::flatBytes(head.meta.level.value_or(micromap::maxLevel), micromap::Format::fourState);
    return (filMostPayloadGrowth * flat + filMostMapBytes) * head.mapCount + filMostPayloadBase;
}

// The `bits` <= 32 bits from bit `at` of `bytes` on, which hold them.
uint64_t bitsAt(std::span<const uint8_t> bytes, uint64_t at, unsigned bits) {
    uint64_t value = 0;
    const uint64_t last = (at + bits - 1) / 8;
    for (uint64_t byte = last + 1; byte-- > at / 8;) value = value << 8 | bytes[byte];
    return value >> (at % 8) & ((uint64_t{1} << bits) - 1);
}

}  // namespace

Result<FilAsset> identifyAsset(const std::filesystem::path& path) {
    const Result<MappedFile> file = MappedFile::open(path);
    if (!file) return file.error();
    const XXH128_hash_t hash = XXH3_128bits(file->bytes().data(), file->bytes().size());
    return FilAsset{path.filename().string(), file->bytes().size(), {hash.low64, hash.high64}};
}

bool isFil(const std::filesystem::path& path) {
    std::array<char, filMagic.size()> begin{};
    std::ifstream file(path, std::ios::binary);
    file.read(begin.data(), begin.size());
    return file && std::equal(begin.begin(), begin.end(), filMagic.begin(),
                              [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; });
}

std::string contentOf(const FilAsset& asset) {
    return fmt::format("{} bytes, hash {:016x}{:016x}", asset.bytes, asset.hash[1], asset.hash[0]);
}

Result<FilFile> FilFile::read(const std::filesystem::path& path, const FilReadOptions& options) {
    Result<MappedFile> mapped = MappedFile::open(path);
    if (!mapped) return mapped.error();
    FilFile file;
    file.mapped_ = std::move(*mapped);
    if (const Status status = file.open(file.mapped_.bytes(), options); !status)
        return status.error().within(path.string());
    return file;
}

Result<FilFile> FilFile::parse(std::vector<uint8_t> bytes, const std::string& name,
                               const FilReadOptions& options) {
    FilFile file;
    file.bytes_ = std::move(bytes);
    if (const Status status = file.open(file.bytes_, options); !status) return status.error().within(name);
    return file;
}

Status FilFile::open(std::span<const uint8_t> bytes, const FilReadOptions& options) {
    fileBytes_ = bytes.size();
    auto table = readTable(bytes);
    if (!table) return table.error();
    Sections sections(std::move(*table), options.maxBytes, plain_);
    const auto meta = sections.take(FilKind::meta, 0, filMostMetaBytes);
    if (!meta) return meta.error();
    Result<FilHead> head = decodeMeta(*meta);
    if (!head) return head.error().within("section meta");
    meta_ = std::move(head->meta);
    const uint64_t triangles = meta_.triangleCount();
    const uint64_t indexBytes = filIndexBytes(head->encoding, head->mapCount, triangles);
    const auto indices = sections.take(FilKind::indices, indexBytes, indexBytes);
    if (!indices) return indices.error();
    indices_ = *indices;
    const auto descriptors = sections.take(FilKind::descriptors, 0, mostDescriptorBytes(*head));
    if (!descriptors) return descriptors.error();
    const auto payload = sections.take(FilKind::payload, 0, mostPayloadBytes(*head));
    if (!payload) return payload.error();
    set_ = {head->encoding, head->format, head->mapCount, *descriptors, *payload};
    if (sections.has(FilKind::pairs)) {
        const uint64_t pairBytes = (uint64_t{head->mapCount} + 3) / 4;
        const auto pairs = sections.take(FilKind::pairs, pairBytes, pairBytes);
        if (!pairs) return pairs.error();
        pairs_ = *pairs;
    }
    return checkIndices();
}

Status FilFile::checkIndices() const {
    const unsigned bits = filIndexBits(set_.encoding, set_.mapCount);
    if (bits == 0) return {};
    const uint64_t triangles = meta_.triangleCount();
    for (uint64_t t = 0; t < triangles; ++t) {
        const uint64_t code = bitsAt(indices_, t * bits, bits);
        if (code < uint64_t{set_.mapCount} + filSpecials) continue;
        return Error{ErrorKind::format, fmt::format("section indices: triangle {} has map {} of {}", t,
                                                    code - filSpecials, set_.mapCount)};
    }
    const auto used = static_cast<unsigned>(triangles * bits % 8);
    if (used != 0 && indices_.back() >> used != 0)
        return Error{ErrorKind::format, "section indices: spare bits of the last byte are not zero"};
    return {};
}

void FilFile::readIndices(uint64_t first, std::span<int32_t> to) const {
    const unsigned bits = filIndexBits(set_.encoding, set_.mapCount);
    assert(bits > 0 && first + to.size() <= meta_.triangleCount());
    for (size_t k = 0; k < to.size(); ++k) {
        const auto code = static_cast<int64_t>(bitsAt(indices_, (first + k) * bits, bits));
        to[k] = static_cast<int32_t>(code < filSpecials ? -1 - code : code - filSpecials);
    }
}

}  // namespace filigree::io
