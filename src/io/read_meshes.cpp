#include "io/read_parts.h"

#include <cmath>

#include <fmt/format.h>

namespace filigree::io {
namespace {

constexpr uint64_t modeTriangles = 4;

mesh::Uv transformed(const Element& uv, const TextureCoordinates& c, double cosine, double sine) {
    // KHR_texture_transform: scale, then counter-clockwise rotation as seen with v down, then offset.
    const double u = uv[0] * c.scale[0];
    const double v = uv[1] * c.scale[1];
    return {static_cast<float>(cosine * u + sine * v + c.offset[0]),
            static_cast<float>(cosine * v - sine * u + c.offset[1])};
}

// Reads one list of triangles.
class PrimitiveReader {
  public:
    PrimitiveReader(SceneReading& reading, const Json& json, std::string path, scene::Primitive& to)
        : reading_(reading), json_(json), path_(std::move(path)), to_(to) {}

    // Positions and indices, and with `full` what alpha needs.
    Status read(const MaterialUse* use, bool hasTexture, bool full) {
        if (const Json* draco = extensionOf(json_, "KHR_draco_mesh_compression"); draco != nullptr) {
            return Error{ErrorKind::unsupported,
                         path_ + ": KHR_draco_mesh_compression is not read; decompress the file first"};
        }
        if (const Status status = readPositions(); !status) return status;
        if (const Status status = readIndices(); !status) return status;
        if (use != nullptr && hasTexture && (full || reading_.options.colour)) {
            if (const Status status = readUvs(use->coordinates); !status) return status;
        }
        return full ? readAlphas() : Status();
    }

  private:
    // The elements of an attribute, or none when the primitive lacks it.
    Result<std::optional<Elements>> attribute(const std::string& name, size_t expectedCount) {
        ObjectReader primitive(json_, path_);
        ObjectReader attributes(primitive.object("attributes"), primitive.pathOf("attributes"));
        const std::optional<uint64_t> index =
            attributes.optionalIndex(name.c_str(), reading_.data.list("accessors").size());
        if (const Status status = primitive.status(); !status) return status.error();
        if (const Status status = attributes.status(); !status) return status.error();
        if (!index) return std::optional<Elements>();
        Result<Elements> elements = findElements(reading_.data, *index);
        if (!elements) return elements.error().within(attributes.pathOf(name));
        if (expectedCount != 0 && elements->accessor.count != expectedCount) {
            return Error{ErrorKind::format,
                         fmt::format("{}: {} elements, expected one for each of {} vertices",
                                     attributes.pathOf(name), elements->accessor.count, expectedCount)};
        }
        return std::optional<Elements>(std::move(*elements));
    }

    Error wrongType(const std::string& name, const Accessor& accessor, std::string_view expected) const {
        return {ErrorKind::format,
                fmt::format("{}/attributes/{}: found {} of component type {}, expected {}", path_, name,
                            accessor.type, static_cast<uint32_t>(accessor.componentType), expected)};
    }

    Status readPositions() {
        const Result<std::optional<Elements>> found = attribute("POSITION", 0);
        if (!found) return found.error();
        if (!*found) return Error{ErrorKind::format, path_ + "/attributes: no POSITION"};
        const Accessor& accessor = (*found)->accessor;
        if (accessor.type != "VEC3") return wrongType("POSITION", accessor, "VEC3");
        if (accessor.count > UINT32_MAX) {
            return Error{ErrorKind::limit, accessor.path + "/count: more vertices than 32-bit indices reach"};
        }
        if (const Status taken = reading_.take(accessor.count * 12, accessor.path); !taken) return taken;
        to_.positions.resize(accessor.count);
        forEachElement(**found, [&](uint64_t i, const Element& e) {
            for (size_t c = 0; c < 3; ++c) to_.positions[i][c] = static_cast<float>(e[c]);
        });
        return {};
    }

    Status readIndices() {
        ObjectReader primitive(json_, path_);
        const std::optional<uint64_t> index =
            primitive.optionalIndex("indices", reading_.data.list("accessors").size());
        if (const Status status = primitive.status(); !status) return status;
        if (!index) return countUp();
        const Result<Elements> elements = findElements(reading_.data, *index);
        if (!elements) return elements.error().within(path_ + "/indices");
        return storeIndices(*elements);
    }

    Status countUp() {
        const size_t count = to_.positions.size() / 3 * 3;
        if (const Status taken = reading_.take(count * 4, path_); !taken) return taken;
        to_.indices.resize(count);
        for (size_t i = 0; i < count; ++i) to_.indices[i] = static_cast<uint32_t>(i);
        return {};
    }

    Status storeIndices(const Elements& elements) {
        const Accessor& accessor = elements.accessor;
        const bool isInteger =
            !isSigned(accessor.componentType) && accessor.componentType != ComponentType::float32;
        if (accessor.type != "SCALAR" || !isInteger || accessor.normalized) {
            return Error{
                ErrorKind::format,
                fmt::format("{}: found {} of component type {}, expected SCALAR of 5121, 5123 or 5125",
                            accessor.path, accessor.type, static_cast<uint32_t>(accessor.componentType))};
        }
        if (const Status taken = reading_.take(accessor.count * 4, accessor.path); !taken) return taken;
        to_.indices.resize(accessor.count);
        forEachElement(elements,
                       [&](uint64_t i, const Element& e) { to_.indices[i] = static_cast<uint32_t>(e[0]); });
        to_.indices.resize(accessor.count / 3 * 3);
        return checkIndices(accessor.path);
    }

    [[nodiscard]] Status checkIndices(const std::string& accessor) const {
        for (size_t i = 0; i < to_.indices.size(); ++i) {
            if (to_.indices[i] < to_.positions.size()) continue;
            return Error{ErrorKind::format,
                         fmt::format("{}/indices: {}: index {} of triangle {} is {}, expected below {}",
                                     path_, accessor, i % 3, i / 3, to_.indices[i], to_.positions.size())};
        }
        return {};
    }

    Status readUvs(const TextureCoordinates& coordinates) {
        const std::string name = fmt::format("TEXCOORD_{}", coordinates.set);
        const Result<std::optional<Elements>> found = attribute(name, to_.positions.size());
        if (!found) return found.error();
        if (!*found) {
            reading_.note(fmt::format("{}: its texture needs {}, which the primitive lacks", path_, name));
            return {};
        }
        const Accessor& accessor = (*found)->accessor;
        if (accessor.type != "VEC2") return wrongType(name, accessor, "VEC2");
        if (const Status taken = reading_.take(accessor.count * sizeof(mesh::Uv), accessor.path); !taken)
            return taken;
        to_.uvs.resize(accessor.count);
        storeUvs(**found, coordinates);
        return {};
    }

    void storeUvs(const Elements& elements, const TextureCoordinates& coordinates) {
        if (coordinates.isIdentity()) {
            forEachElement(elements, [&](uint64_t i, const Element& e) {
                to_.uvs[i] = {static_cast<float>(e[0]), static_cast<float>(e[1])};
            });
            return;
        }
        const double cosine = std::cos(coordinates.rotation);
        const double sine = std::sin(coordinates.rotation);
        forEachElement(elements, [&](uint64_t i, const Element& e) {
            to_.uvs[i] = transformed(e, coordinates, cosine, sine);
        });
    }

    Status readAlphas() {
        const Result<std::optional<Elements>> found = attribute("COLOR_0", to_.positions.size());
        if (!found) return found.error();
        if (!*found || (*found)->accessor.type == "VEC3") return {};
        const Accessor& accessor = (*found)->accessor;
        if (accessor.type != "VEC4") return wrongType("COLOR_0", accessor, "VEC3 or VEC4");
        if (accessor.componentType != ComponentType::float32 && !accessor.normalized) {
            return wrongType("COLOR_0", accessor, "float or normalized integers");
        }
        if (const Status taken = reading_.take(accessor.count * 4, accessor.path); !taken) return taken;
        to_.alphas.resize(accessor.count);
        forEachElement(**found,
                       [&](uint64_t i, const Element& e) { to_.alphas[i] = static_cast<float>(e[3]); });
        return {};
    }

    SceneReading& reading_;
    const Json& json_;
    std::string path_;
    scene::Primitive& to_;
};

void clearGeometry(scene::Primitive& primitive) {
    primitive.positions = {};
    primitive.uvs = {};
    primitive.alphas = {};
    primitive.indices = {};
}

// Geometry that alpha needs fails the file; any other is noted and left out.
Status readGeometry(SceneReading& reading, const Json& json, const std::string& path, scene::Primitive& to) {
    const MaterialUse* use =
        to.material >= 0 ? &reading.materials[static_cast<size_t>(to.material)] : nullptr;
    const bool hasTexture =
        use != nullptr && reading.scene.materials[static_cast<size_t>(to.material)].image >= 0;
    const bool full = use != nullptr && use->needsAlpha;
    const Status status = PrimitiveReader(reading, json, path, to).read(use, hasTexture, full);
    if (status || full || status.error().kind == ErrorKind::limit) return status;
    clearGeometry(to);
    reading.note(status.error().message + " (passed over: its alpha is not needed)");
    return {};
}

Status readPrimitive(SceneReading& reading, const Json& json, const std::string& path, scene::Primitive to,
                     scene::Mesh& mesh) {
    ObjectReader reader(json, path);
    const uint64_t mode = reader.optionalInteger("mode", 0, 6).value_or(modeTriangles);
    const std::optional<uint64_t> material = reader.optionalIndex("material", reading.materials.size());
    if (const Status status = reader.status(); !status) return status;
    if (mode != modeTriangles) {
        reading.note(fmt::format("{}: mode {} is not a list of triangles, passed over", path, mode));
        return {};
    }
    if (material) to.material = static_cast<int>(*material);
    if (const Status status = readGeometry(reading, json, path, to); !status) return status;
    if (reading.options.micromaps) {
        if (const Status status = readMicromapIndices(reading, json, path, to); !status) return status;
    }
    mesh.primitives.push_back(std::move(to));
    return {};
}

Status readMesh(SceneReading& reading, size_t index) {
    scene::Mesh& mesh = reading.scene.meshes[index];
    ObjectReader reader = reading.data.item("meshes", index);
    mesh.name = reader.text("name", "");
    const Json& primitives = reader.array("primitives");
    if (const Status status = reader.status(); !status) return status;
    if (primitives.empty()) {
        return Error{ErrorKind::format, reader.path() + "/primitives: empty, expected at least one"};
    }
    for (size_t p = 0; p < primitives.size(); ++p) {
        scene::Primitive to;
        to.meshIndex = static_cast<unsigned>(index);
        to.primitiveIndex = static_cast<unsigned>(p);
        const std::string path = fmt::format("{}/primitives/{}", reader.path(), p);
        if (const Status status = readPrimitive(reading, primitives[p], path, std::move(to), mesh); !status) {
            return status;
        }
    }
    return {};
}

}  // namespace

Status readMeshes(SceneReading& reading) {
    reading.scene.meshes.resize(reading.data.list("meshes").size());
    for (size_t m = 0; m < reading.scene.meshes.size(); ++m) {
        if (const Status status = readMesh(reading, m); !status) return status;
    }
    return {};
}

}  // namespace filigree::io
