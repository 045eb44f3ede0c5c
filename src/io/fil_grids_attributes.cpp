#include "io/fil_grids_attributes.h"

#include "io/words.h"

namespace filigree::io {
namespace {

std::vector<grid::Diagonal> unpackDiagonals(std::span<const uint8_t> bytes, uint64_t quads) {
    std::vector<grid::Diagonal> diagonals(quads);
    for (uint64_t k = 0; k < quads; ++k)
        diagonals[k] = (bytes[k / 8] >> (k % 8) & 1) != 0 ? grid::Diagonal::bd : grid::Diagonal::ac;
    return diagonals;
}

uint64_t vertexCount(const FilGrids& grids) {
    return grids.table.empty() ? 0 : grids.table.back().firstVertex + grids.table.back().vertexCount();
}

// Takes the sections of attributes.
class AttributeReader {
  public:
    AttributeReader(FilSections& sections, uint32_t looseVertices, FilGrids& to)
        : sections_(sections), looseVertices_(looseVertices), to_(to), vertices_(vertexCount(to)) {}

    Status run() {
        for (const auto step : {&AttributeReader::diagonals, &AttributeReader::sources,
                                &AttributeReader::corners, &AttributeReader::values}) {
            if (const Status status = (this->*step)(); !status) return status;
        }
        return {};
    }

  private:
    // The section's bytes, or none where it is missing.
    Result<std::span<const uint8_t>> some(FilKind kind, uint64_t bytes) {
        if (!sections_.has(kind)) return std::span<const uint8_t>();
        return sections_.take(kind, bytes, bytes);
    }
    Status diagonals() {
        const uint64_t quads = to_.quadCount();
        const auto bytes = some(FilKind::diagonals, (quads + 7) / 8);
        if (!bytes) return bytes.error();
        if (bytes->empty()) return {};
        if (quads % 8 != 0 && bytes->back() >> (quads % 8) != 0)
            return Error{ErrorKind::format, "section diagonals: spare bits of the last byte are not zero"};
        to_.attributes.diagonals = unpackDiagonals(*bytes, quads);
        return {};
    }
    Status sources() {
        const uint64_t ofQuads = to_.quadCount() * sizeof(std::array<uint32_t, 2>);
        const auto bytes = some(FilKind::sources, ofQuads + uint64_t{to_.looseTriangles} * sizeof(uint32_t));
        if (!bytes) return bytes.error();
        if (bytes->empty()) return {};
        to_.attributes.quadSources = unpackWords<std::array<uint32_t, 2>>(bytes->first(ofQuads));
        to_.attributes.looseSources = unpackWords<uint32_t>(bytes->subspan(ofQuads));
        return {};
    }
    Status corners() {
        const auto bytes = some(FilKind::corners, uint64_t{12} * to_.looseTriangles);
        if (!bytes) return bytes.error();
        to_.attributes.looseTriangles = unpackWords<std::array<uint32_t, 3>>(*bytes);
        for (size_t t = 0; t < to_.attributes.looseTriangles.size(); ++t) {
            for (const uint32_t corner : to_.attributes.looseTriangles[t]) {
                if (corner < looseVertices_) continue;
                return Error{ErrorKind::format,
                             fmt::format("section corners: loose triangle {} has vertex {} of {}", t, corner,
                                         looseVertices_)};
            }
        }
        return {};
    }
    Status values() {
        const auto normals = some(FilKind::normals, 12 * (vertices_ + looseVertices_));
        if (!normals) return normals.error();
        split(*normals, to_.attributes.normals, to_.attributes.looseNormals);
        const auto uvs = some(FilKind::uvs, 8 * (vertices_ + looseVertices_));
        if (!uvs) return uvs.error();
        split(*uvs, to_.attributes.uvs, to_.attributes.looseUvs);
        const bool hasLoose = !to_.attributes.looseNormals.empty() || !to_.attributes.looseUvs.empty();
        if (hasLoose && to_.attributes.looseTriangles.empty())
            return Error{ErrorKind::format, "section corners: is missing"};
        return {};
    }
    template <class T>
    void split(std::span<const uint8_t> bytes, std::vector<T>& ofGrids, std::vector<T>& ofLoose) const {
        if (bytes.empty()) return;
        ofGrids = unpackWords<T>(bytes.first(vertices_ * sizeof(T)));
        ofLoose = unpackWords<T>(bytes.subspan(vertices_ * sizeof(T)));
    }

    FilSections& sections_;
    uint32_t looseVertices_;
    FilGrids& to_;
    uint64_t vertices_;
};

}  // namespace

Status readGridAttributes(FilSections& sections, uint32_t looseVertices, FilGrids& to) {
    return AttributeReader(sections, looseVertices, to).run();
}

}  // namespace filigree::io
