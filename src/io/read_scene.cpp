#include "filigree/io/gltf.h"

#include "io/read_parts.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace filigree::io {
namespace {

// Extensions that may be required: understood here, or without a say in alpha and geometry, or looked at
// where a masked material needs what they hold (textures of other formats).
constexpr std::array<std::string_view, 14> acceptedExtensions{
    "EXT_mesh_gpu_instancing",   "EXT_mesh_opacity_micromap", "EXT_texture_avif",
    "EXT_texture_webp",          "KHR_animation_pointer",     "KHR_lights_punctual",
    "KHR_mesh_opacity_micromap", "KHR_mesh_quantization",     "KHR_node_visibility",
    "KHR_texture_basisu",        "KHR_texture_transform",     "KHR_xmp_json_ld",
    "EXT_lights_image_based",    "MSFT_texture_dds"};

bool isAccepted(std::string_view extension) {
    // Takes base colour from elsewhere, so it is not like the other material extensions.
    if (extension == "KHR_materials_pbrSpecularGlossiness") return false;
    return extension.starts_with("KHR_materials_") ||
           std::find(acceptedExtensions.begin(), acceptedExtensions.end(), extension) !=
               acceptedExtensions.end();
}

// Things that change alpha at run time and that no bake reflects.
void noteChangingAlpha(SceneReading& reading) {
    const bool needed = std::any_of(reading.materials.begin(), reading.materials.end(),
                                    [](const MaterialUse& use) { return use.needsAlpha && use.used; });
    if (!needed) return;
    for (const char* extension : {"KHR_materials_variants", "KHR_animation_pointer"}) {
        if (!listsExtension(reading.data.json, "extensionsUsed", extension)) continue;
        reading.note(
            fmt::format("{} is used: micromaps follow the materials as they stand in the file, not what it "
                        "changes at run time",
                        extension));
    }
}

}  // namespace

Status SceneReading::take(uint64_t bytes, const std::string& path) {
    if (bytes > bytesLeft) {
        return Error{ErrorKind::limit,
                     fmt::format("{}: needs {} bytes, which passes the limit of {} for a scene", path, bytes,
                                 options.maxBytes)};
    }
    bytesLeft -= bytes;
    return {};
}

Status checkRequiredExtensions(const GltfDocument::Data& data) {
    const Json& required = data.list("extensionsRequired");
    for (size_t i = 0; i < required.size(); ++i) {
        const std::string path = fmt::format("/extensionsRequired/{}", i);
        if (!required[i].is_string()) {
            return Error{ErrorKind::format,
                         fmt::format("{}: found {}, expected a string", path, describe(required[i]))};
        }
        const auto& name = required[i].get_ref<const std::string&>();
        if (!isAccepted(name)) {
            return Error{ErrorKind::unsupported,
                         fmt::format("{}: the file requires {}, which is not read", path, name)};
        }
    }
    return {};
}

Result<scene::Scene> readScene(const GltfDocument& document, const ReadOptions& options) {
    SceneReading reading{document.data(), options, {}, {}, {}, options.maxBytes};
    const auto run = [&](Status (*part)(SceneReading&)) { return part(reading); };
    Status status = checkRequiredExtensions(reading.data);
    for (const auto part : {readMaterials, readImages, readMicromaps, readMeshes, readNodes}) {
        if (status) status = run(part);
    }
    if (!status) return status.error().within(document.name());
    noteChangingAlpha(reading);
    return std::move(reading.scene);
}

}  // namespace filigree::io
