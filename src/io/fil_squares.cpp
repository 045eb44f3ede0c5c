#include "filigree/io/fil_squares.h"

#include "io/fil_layout.h"
#include "io/fil_loading.h"

#include <cassert>

namespace filigree::io {
namespace {

constexpr size_t placeCodes = 2 * quadmap::squareOrders.size();

unsigned placeCode(std::span<const uint8_t> places, uint64_t triangle) {
    return places[triangle / 2] >> (4 * (triangle % 2)) & 15U;
}

Status checkPlaces(std::span<const uint8_t> places, uint64_t triangles) {
    for (uint64_t t = 0; t < triangles; ++t) {
        if (placeCode(places, t) < placeCodes) continue;
        return Error{ErrorKind::format,
                     fmt::format("section descriptors: triangle {} has place {}, expected 0 to {}", t,
                                 placeCode(places, t), placeCodes - 1)};
    }
    if (triangles % 2 != 0 && places.back() >> 4 != 0)
        return Error{ErrorKind::format, "section descriptors: spare bits of the last byte are not zero"};
    return {};
}

}  // namespace

Result<FilSquareFile> FilSquareFile::read(const std::filesystem::path& path, const FilReadOptions& options) {
    return FilLoading::read<FilSquareFile>(path, options);
}

Result<FilSquareFile> FilSquareFile::parse(std::vector<uint8_t> bytes, const std::string& name,
                                           const FilReadOptions& options) {
    return FilLoading::parse<FilSquareFile>(std::move(bytes), name, options);
}

Result<FilSquareFile> FilSquareFile::view(std::span<const uint8_t> bytes, const std::string& name,
                                          const FilReadOptions& options) {
    return FilLoading::view<FilSquareFile>(bytes, name, options);
}

Status FilSquareFile::open(std::span<const uint8_t> bytes, const FilReadOptions& options) {
    fileBytes_ = bytes.size();
    auto table = readTable(bytes);
    if (!table) return table.error();
    FilSections sections(std::move(*table), options.maxBytes, plain_);
    auto head = headOf(sections);
    if (!head) return head.error();
    if (!head->squares) return Error{ErrorKind::format, "holds micromaps, expected opacity squares"};
    if (head->meta.level || head->format != micromap::Format::fourState)
        return Error{ErrorKind::format, "section meta: squares have 4 states and level 255"};
    if (const Status status =
            sections.allowOnly({FilKind::meta, FilKind::indices, FilKind::descriptors, FilKind::payload});
        !status)
        return status;
    meta_ = std::move(head->meta);
    const uint64_t triangles = meta_.triangleCount();
    const uint64_t indexBytes = filIndexBytes(head->encoding, head->mapCount, triangles);
    const auto indices = sections.take(FilKind::indices, indexBytes, indexBytes);
    if (!indices) return indices.error();
    indices_ = *indices;
    const auto places = sections.take(FilKind::descriptors, (triangles + 1) / 2, (triangles + 1) / 2);
    if (!places) return places.error();
    places_ = *places;
    const uint64_t blockBytes = uint64_t{head->mapCount} * blockBytesOf(*head->squares);
    const auto blocks = sections.take(FilKind::payload, blockBytes, blockBytes);
    if (!blocks) return blocks.error();
    auto maps = quadmap::SquareReader::open(*head->squares, *blocks);
    if (!maps) return maps.error().within("section payload");
    maps_ = *maps;
    if (auto checked = checkPlaces(places_, triangles); !checked) return checked;
    return checkFilIndices(indices_, filIndexBits(head->encoding, head->mapCount), triangles, head->mapCount);
}

void FilSquareFile::readIndices(uint64_t first, std::span<int32_t> to) const {
    assert(first + to.size() <= meta_.triangleCount());
    const auto mapCount = static_cast<uint32_t>(maps_->mapCount());
    readFilIndices(indices_, filIndexBits({}, mapCount), first, to);
}

quadmap::SquarePlace FilSquareFile::place(uint64_t triangle) const {
    const unsigned code = placeCode(places_, triangle);
    return {static_cast<quadmap::Half>(code & 1), static_cast<uint8_t>(code >> 1)};
}

std::optional<quadmap::SquareFormat> squaresIn(const std::filesystem::path& path) {
    const auto mapped = MappedFile::open(path);
    return mapped ? squaresIn(mapped->bytes()) : std::nullopt;
}

std::optional<quadmap::SquareFormat> squaresIn(std::span<const uint8_t> bytes) {
    auto table = readTable(bytes);
    if (!table) return std::nullopt;
    std::vector<std::vector<uint8_t>> plain;
    FilSections sections(std::move(*table), filMostMetaBytes, plain);
    const auto head = headOf(sections);
    return head ? head->squares : std::nullopt;
}

}  // namespace filigree::io
