#include "filigree/core/file.h"
#include "filigree/io/gltf_write.h"

#include "io/accessor.h"
#include "io/micromap_bytes.h"
#include "io/output_check.h"
#include "io/test_json.h"
#include "io/write_buffers.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace filigree::io {
namespace {

constexpr const char* extensionName = micromapExtensions[0];
constexpr const char* olderName = micromapExtensions[1];

// Calls each(primitive) for every primitive of the document that is an object.
template <class Each>
void forEachPrimitive(Json& json, Each&& each) {
    for (Json& mesh : arrayIn(json, "meshes")) {
        if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array()) continue;
        for (Json& primitive : mesh["primitives"]) {
            if (primitive.is_object()) each(primitive);
        }
    }
}

// Takes `name` out of a list of names, and the list away when that leaves it empty.
void unlist(Json& json, const char* key, const char* name) {
    if (!json.contains(key) || !json[key].is_array()) return;
    Json& names = json[key];
    names.erase(std::remove(names.begin(), names.end(), Json(name)), names.end());
    if (names.empty()) json.erase(key);
}

// Takes an extension out of an object, and "extensions" away when that leaves it empty.
void dropExtension(Json& owner, const char* name) {
    if (extensionOf(owner, name) == nullptr) return;
    owner["extensions"].erase(name);
    if (owner["extensions"].empty()) owner.erase("extensions");
}

// Drops the old micromaps that no primitive uses any more and renumbers the uses of the others. Leaves all as
// it is when a use cannot be read.
void dropUnused(Json& json, Json& micromaps) {
    std::vector<Json*> uses;
    std::vector<bool> used(micromaps.size());
    bool readable = true;
    forEachPrimitive(json, [&](Json& primitive) {
        if (extensionOf(primitive, extensionName) == nullptr) return;
        Json& extension = primitive["extensions"][extensionName];
        const Json* index = memberOf(extension, "micromap");
        readable =
            readable && index != nullptr && index->is_number_unsigned() && index->get<size_t>() < used.size();
        if (!readable) return;
        used[index->get<size_t>()] = true;
        uses.push_back(&extension["micromap"]);
    });
    if (!readable) return;
    std::vector<size_t> renumbered(used.size());
    Json kept = Json::array();
    for (size_t i = 0; i < used.size(); ++i) {
        renumbered[i] = kept.size();
        if (used[i]) kept.push_back(std::move(micromaps[i]));
    }
    for (Json* use : uses) *use = renumbered[use->get<size_t>()];
    micromaps = std::move(kept);
}

// Drops the older name of the extension once no primitive carries it.
void dropOlderName(Json& json) {
    bool carried = false;
    forEachPrimitive(json, [&](Json& primitive) { carried |= extensionOf(primitive, olderName) != nullptr; });
    if (carried || extensionOf(json, olderName) == nullptr) return;
    dropExtension(json, olderName);
    unlist(json, "extensionsUsed", olderName);
    unlist(json, "extensionsRequired", olderName);
}

Json micromapToJson(const OutputMicromaps& micromaps, Rewrite& rewrite) {
    const micromap::FlatSet& set = *micromaps.set;
    Json json = Json::object();
    if (!micromaps.name.empty()) json["name"] = micromaps.name;
    json["data"] = rewrite.addView(std::vector<uint8_t>(set.data), "opacity micromap data");
    json["triangles"] = rewrite.addView(encodeRecords(set.records), "opacity micromap records");
    for (const char* key : {"usageCounts", "usageLevels", "usageFormats"}) json[key] = Json::array();
    for (const micromap::UsageCount& usage : micromap::usageCounts(set.records)) {
        json["usageCounts"].push_back(usage.count);
        json["usageLevels"].push_back(usage.level);
        json["usageFormats"].push_back(static_cast<unsigned>(usage.format));
    }
    if (micromaps.test) json["extras"]["filigree"] = testToJson(*micromaps.test);
    return json;
}

ComponentType unsignedType(size_t bytes) {
    return bytes == 1 ? ComponentType::uint8 : bytes == 2 ? ComponentType::uint16 : ComponentType::uint32;
}

size_t addAccessor(Rewrite& rewrite, size_t view, size_t offset, ComponentType type, size_t count) {
    Json json = Json::object();
    json["bufferView"] = view;
    if (offset != 0) json["byteOffset"] = offset;
    json["componentType"] = static_cast<uint32_t>(type);
    json["count"] = count;
    json["type"] = "SCALAR";
    return rewrite.append("accessors", std::move(json));
}

// Accessors of the micromap indices of all primitives, in one buffer view.
std::vector<size_t> addIndexAccessors(const MicromapOutput& output, Rewrite& rewrite) {
    std::vector<uint8_t> bytes;
    std::vector<size_t> offsets;
    for (const OutputPrimitive& primitive : output.primitives) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        offsets.push_back(bytes.size());
        const std::vector<uint8_t> encoded =
            encodeIndices(primitive.indices, micromap::indexBytes(primitive.indices));
        bytes.insert(bytes.end(), encoded.begin(), encoded.end());
    }
    const size_t view = rewrite.addView(std::move(bytes), "opacity micromap indices");
    std::vector<size_t> accessors;
    for (size_t i = 0; i < offsets.size(); ++i) {
        const std::span<const int32_t> indices = output.primitives[i].indices;
        accessors.push_back(addAccessor(rewrite, view, offsets[i],
                                        unsignedType(micromap::indexBytes(indices)), indices.size()));
    }
    return accessors;
}

// The vertex indices of a primitive whose triangles were rotated, in an accessor of their own.
size_t addVertexIndices(std::span<const uint32_t> indices, Rewrite& rewrite) {
    constexpr size_t elementArrayBuffer = 34963;
    // The largest value of a type is the primitive restart value and may not occur.
    const size_t bytes = *std::max_element(indices.begin(), indices.end()) < 65535 ? 2 : 4;
    std::vector<uint8_t> encoded(indices.size() * bytes);
    for (size_t i = 0; i < indices.size(); ++i) {
        for (size_t k = 0; k < bytes; ++k)
            encoded[i * bytes + k] = static_cast<uint8_t>(indices[i] >> (8 * k));
    }
    const size_t view = rewrite.addView(std::move(encoded), "rotated indices");
    rewrite.json["bufferViews"][view]["target"] = elementArrayBuffer;
    return addAccessor(rewrite, view, 0, unsignedType(bytes), indices.size());
}

// Whether the document has the primitives that get micromaps.
Status checkPlaces(const GltfDocument::Data& data, const MicromapOutput& output) {
    const Json& meshes = data.list("meshes");
    for (const OutputPrimitive& item : output.primitives) {
        const Json* primitives =
            item.mesh < meshes.size() ? memberOf(meshes[item.mesh], "primitives") : nullptr;
        if (primitives != nullptr && primitives->is_array() && item.primitive < primitives->size()) continue;
        return Error{ErrorKind::usage,
                     fmt::format("the document has no primitive {} of mesh {}", item.primitive, item.mesh)};
    }
    return {};
}

Json& primitiveOf(Json& json, const OutputPrimitive& output) {
    return json["meshes"][output.mesh]["primitives"][output.primitive];
}

void detachOld(Rewrite& rewrite, const MicromapOutput& output) {
    for (const OutputPrimitive& primitive : output.primitives) {
        for (const char* name : micromapExtensions) dropExtension(primitiveOf(rewrite.json, primitive), name);
    }
    dropOlderName(rewrite.json);
}

Status attach(const GltfDocument& document, const MicromapOutput& output, Rewrite& rewrite) {
    if (output.primitives.empty()) return {};
    Status status = checkOutput(output);
    if (status) status = checkPlaces(document.data(), output);
    if (!status) return status.error().within(document.name());
    detachOld(rewrite, output);
    Json micromaps = arrayIn(objectIn(objectIn(rewrite.json, "extensions"), extensionName), "micromaps");
    dropUnused(rewrite.json, micromaps);
    const size_t first = micromaps.size();
    for (const OutputMicromaps& item : output.micromaps) micromaps.push_back(micromapToJson(item, rewrite));
    rewrite.json["extensions"][extensionName]["micromaps"] = std::move(micromaps);

    const std::vector<size_t> accessors = addIndexAccessors(output, rewrite);
    for (size_t i = 0; i < output.primitives.size(); ++i) {
        const OutputPrimitive& item = output.primitives[i];
        if (!item.vertexIndices.empty()) {
            const size_t accessor = addVertexIndices(item.vertexIndices, rewrite);
            primitiveOf(rewrite.json, item)["indices"] = accessor;
        }
        Json& extension = objectIn(objectIn(primitiveOf(rewrite.json, item), "extensions"), extensionName);
        extension["micromap"] = first + item.micromaps;
        extension["micromapIndices"] = accessors[i];
    }
    unlist(rewrite.json, "extensionsRequired", extensionName);
    if (!listsExtension(rewrite.json, "extensionsUsed", extensionName)) {
        arrayIn(rewrite.json, "extensionsUsed").push_back(extensionName);
    }
    return {};
}

bool wantsText(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".gltf";
}

}  // namespace

Status writeWithMicromaps(const GltfDocument& document, const MicromapOutput& output,
                          const std::filesystem::path& path) {
    if (!wantsText(path)) {
        const Result<std::vector<uint8_t>> glb = encodeWithMicromaps(document, output);
        return glb ? writeFile(path, *glb) : Status(glb.error());
    }
    Result<Rewrite> rewrite = rewriteForGltf(document.data(), path.parent_path());
    if (!rewrite) return rewrite.error().within(document.name());
    if (const Status status = attach(document, output, *rewrite); !status) return status.error();
    const Result<std::vector<uint8_t>> bytes = finishGltf(*rewrite);
    if (!bytes) return bytes.error().within(path.string());
    return writeFile(path, *bytes);
}

Result<std::vector<uint8_t>> encodeWithMicromaps(const GltfDocument& document, const MicromapOutput& output) {
    Result<Rewrite> rewrite = rewriteForGlb(document.data());
    if (!rewrite) return rewrite.error().within(document.name());
    if (const Status status = attach(document, output, *rewrite); !status) return status.error();
    Result<std::vector<uint8_t>> bytes = finishGlb(*rewrite, document.data());
    if (!bytes) return bytes.error().within(document.name());
    return bytes;
}

}  // namespace filigree::io
