#include "filigree/core/bytes.h"
#include "filigree/io/fil.h"

#include "io/fil_layout.h"
#include "io/fil_loading.h"
#include "io/fil_table.h"

#include <algorithm>
#include <cassert>
#include <fstream>

#include <xxhash.h>

namespace filigree::io {
namespace {

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

}  // namespace

Result<FilAsset> identifyAsset(const std::filesystem::path& path) {
    const Result<MappedFile> file = MappedFile::open(path);
    if (!file) return file.error();
    return identifyAsset(file->bytes(), path.filename().string());
}

FilAsset identifyAsset(std::span<const uint8_t> bytes, const std::string& name) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return {name, bytes.size(), {hash.low64, hash.high64}};
}

bool isFil(const std::filesystem::path& path) {
    std::array<uint8_t, filMagic.size()> begin{};
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(begin.data()), begin.size());
    return file && isFil(begin);
}

bool isFil(std::span<const uint8_t> bytes) {
    return bytes.size() >= filMagic.size() && std::equal(filMagic.begin(), filMagic.end(), bytes.begin());
}

std::string contentOf(const FilAsset& asset) {
    return fmt::format("{} bytes, hash {:016x}{:016x}", asset.bytes, asset.hash[1], asset.hash[0]);
}

Result<FilFile> FilFile::read(const std::filesystem::path& path, const FilReadOptions& options) {
    return FilLoading::read<FilFile>(path, options);
}

Result<FilFile> FilFile::parse(std::vector<uint8_t> bytes, const std::string& name,
                               const FilReadOptions& options) {
    return FilLoading::parse<FilFile>(std::move(bytes), name, options);
}

Result<FilFile> FilFile::view(std::span<const uint8_t> bytes, const std::string& name,
                              const FilReadOptions& options) {
    return FilLoading::view<FilFile>(bytes, name, options);
}

Status FilFile::open(std::span<const uint8_t> bytes, const FilReadOptions& options) {
    fileBytes_ = bytes.size();
    auto table = readTable(bytes);
    if (!table) return table.error();
    FilSections sections(std::move(*table), options.maxBytes, plain_);
    auto head = headOf(sections);
    if (!head) return head.error();
    if (head->squares)
        return Error{ErrorKind::format, fmt::format("holds opacity squares ({}), expected micromaps",
                                                    quadmap::nameOf(*head->squares))};
    if (const Status status = sections.allowOnly(
            {FilKind::meta, FilKind::indices, FilKind::descriptors, FilKind::payload, FilKind::pairs});
        !status)
        return status;
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
    const unsigned bits = filIndexBits(set_.encoding, set_.mapCount);
    return checkFilIndices(indices_, bits, triangles, set_.mapCount);
}

void FilFile::readIndices(uint64_t first, std::span<int32_t> to) const {
    assert(set_.encoding != encoding::Encoding::bitmask && first + to.size() <= meta_.triangleCount());
    readFilIndices(indices_, filIndexBits(set_.encoding, set_.mapCount), first, to);
}

}  // namespace filigree::io
