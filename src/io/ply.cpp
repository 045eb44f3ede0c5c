#include "filigree/io/ply.h"

#include "filigree/core/file.h"

#include "io/ply_values.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace filigree::io {
namespace {

// Where one number of a vertex goes: slot 0..2 position, 3..5 normal, 6 and 7 texture coordinates.
constexpr size_t vertexSlots = 8;
constexpr std::array<std::array<std::string_view, vertexSlots>, 2> slotNames{
    {{"x", "y", "z", "nx", "ny", "nz", "u", "v"}, {"x", "y", "z", "nx", "ny", "nz", "s", "t"}}};

class PlyReading {
  public:
    PlyReading(PlyHeader header, std::span<const uint8_t> body)
        : header_(std::move(header)), values_(header_.format, body) {}

    Result<mesh::FaceMesh> read() {
        const Status parts = findParts();
        if (!parts) return parts.error();
        for (const PlyElement& element : header_.elements) {
            if (const Status read = readElement(element); !read) return read.error();
        }
        if (!values_.atEnd())
            return Error{ErrorKind::format, "more behind the last element, expected the end of the file"};
        return std::move(mesh_);
    }

  private:
    Status findParts() {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") vertex_ = &element;
            if (element.name == "face") face_ = &element;
        }
        if (vertex_ == nullptr) return Error{ErrorKind::format, "no element vertex"};
        if (face_ == nullptr) return Error{ErrorKind::format, "no element face"};
        if (vertex_->count >= mesh::noVertex) {
            return Error{ErrorKind::limit,
                         fmt::format("{} vertices, expected below 2^32 - 1", vertex_->count)};
        }
        if (const Status slots = findSlots(); !slots) return slots.error();
        corners_ = face_->find("vertex_indices");
        if (!corners_) corners_ = face_->find("vertex_index");
        if (!corners_ || !face_->properties[*corners_].countType)
            return Error{ErrorKind::format, "element face: no list vertex_indices or vertex_index"};
        return {};
    }

    Status findSlots() {
        const bool isUv = vertex_->find("u") && vertex_->find("v");
        slotOf_.assign(vertex_->properties.size(), vertexSlots);
        std::array<bool, vertexSlots> found{};
        for (size_t slot = 0; slot < vertexSlots; ++slot) {
            const auto at = vertex_->find(slotNames[isUv ? 0 : 1][slot]);
            found[slot] = at && !vertex_->properties[*at].countType;
            if (found[slot]) slotOf_[*at] = slot;
        }
        if (!found[0] || !found[1] || !found[2])
            return Error{ErrorKind::format, "element vertex: no properties x, y and z"};
        hasNormals_ = found[3] && found[4] && found[5];
        hasUvs_ = found[6] && found[7];
        return {};
    }

    Status readElement(const PlyElement& element) {
        const size_t least = element.leastBytes(header_.format);
        if (!values_.canHold(element.count, least)) {
            return Error{ErrorKind::format, fmt::format("element {}: {} of them, more than the file can hold",
                                                        element.name, element.count)};
        }
        if (least == 0) return {};
        for (uint64_t k = 0; k < element.count; ++k) {
            const bool read = &element == vertex_ ? readVertex() : readOther(element);
            if (!read) return Error{ErrorKind::format, fmt::format("{} {}: {}", element.name, k, failure())};
        }
        return {};
    }

    bool readVertex() {
        std::array<float, vertexSlots + 1> slots{};  // the last takes what is passed over
        for (size_t p = 0; p < vertex_->properties.size(); ++p) {
            const PlyProperty& property = vertex_->properties[p];
            double value = 0;
            if (property.countType ? !values_.skip(property) : !values_.take(property.type, value))
                return false;
            slots[slotOf_[p]] = static_cast<float>(value);
        }
        for (size_t k = 0; k < 3; ++k) {
            if (!std::isfinite(slots[k]))
                return fail(fmt::format("{} is {}, expected finite", slotNames[0][k], slots[k]));
        }
        mesh_.positions.push_back({slots[0], slots[1], slots[2]});
        if (hasNormals_) mesh_.normals.push_back({slots[3], slots[4], slots[5]});
        if (hasUvs_) mesh_.uvs.push_back({slots[6], slots[7]});
        return true;
    }

    bool readOther(const PlyElement& element) {
        for (size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            const bool isFace = &element == face_ && p == *corners_;
            if (isFace ? !readFace(property) : !values_.skip(property)) return false;
        }
        return true;
    }

    bool readFace(const PlyProperty& list) {
        uint64_t count = 0;
        if (!values_.takeCount(list, count)) return false;
        if (count < 3) return fail(fmt::format("{} corners, expected 3 or more", count));
        mesh::Face face{0, 0, 0, mesh::noVertex};
        for (uint64_t k = 0; k < count; ++k) {
            uint32_t corner = 0;
            if (!readCorner(list.type, corner)) return false;
            face[std::min<uint64_t>(k, count == 4 ? 3 : 2)] = corner;
            if (count != 4 && k >= 2) {
                mesh_.faces.push_back(face);
                face[1] = face[2];
            }
        }
        if (count == 4) mesh_.faces.push_back(face);
        return true;
    }

    bool readCorner(PlyType type, uint32_t& corner) {
        double value = 0;
        if (!values_.take(type, value)) return false;
        if (!(value >= 0 && value < static_cast<double>(vertex_->count)) || value != std::floor(value))
            return fail(fmt::format("vertex {}, expected below {}", value, vertex_->count));
        corner = static_cast<uint32_t>(value);
        return true;
    }

    bool fail(std::string failure) {
        failure_ = std::move(failure);
        return false;
    }
    [[nodiscard]] std::string failure() const { return failure_.empty() ? values_.failure() : failure_; }

    PlyHeader header_;
    PlyValues values_;
    const PlyElement* vertex_ = nullptr;
    const PlyElement* face_ = nullptr;
    std::vector<size_t> slotOf_;  // [property of vertex]
    bool hasNormals_ = false;
    bool hasUvs_ = false;
    std::optional<size_t> corners_;  // the property of faces
    std::string failure_;
    mesh::FaceMesh mesh_;
};

}  // namespace

Result<mesh::FaceMesh> parsePly(std::span<const uint8_t> bytes) {
    Result<PlyHeader> header = readPlyHeader(bytes);
    if (!header) return header.error();
    const std::span<const uint8_t> body = bytes.subspan(header->bytes);
    Result<mesh::FaceMesh> mesh = PlyReading(std::move(*header), body).read();
    if (!mesh) return mesh.error();
    if (const Status sound = mesh::check(*mesh); !sound) return sound.error();
    return mesh;
}

Result<mesh::FaceMesh> readPly(const std::filesystem::path& path) {
    const Result<std::vector<uint8_t>> bytes = readFile(path);
    if (!bytes) return bytes.error();
    Result<mesh::FaceMesh> mesh = parsePly(*bytes);
    if (!mesh) return mesh.error().within(path.string());
    return mesh;
}

}  // namespace filigree::io
