#include "io/read_parts.h"

#include <fmt/format.h>

namespace filigree::io {
namespace {

constexpr uint64_t glNearest = 9728;
constexpr uint64_t glLinear = 9729;
constexpr uint64_t glNearestMipmapNearest = 9984;
constexpr uint64_t glLinearMipmapNearest = 9985;
constexpr uint64_t glNearestMipmapLinear = 9986;
constexpr uint64_t glLinearMipmapLinear = 9987;
constexpr uint64_t glClampToEdge = 33071;
constexpr uint64_t glMirroredRepeat = 33648;
constexpr uint64_t glRepeat = 10497;

image::Wrap readWrap(ObjectReader& sampler, const char* key) {
    const uint64_t value = sampler.optionalInteger(key, 0).value_or(glRepeat);
    if (value == glClampToEdge) return image::Wrap::clampToEdge;
    if (value == glMirroredRepeat) return image::Wrap::mirroredRepeat;
    if (value != glRepeat) sampler.fail(key, Json(value), "33071, 33648 or 10497");
    return image::Wrap::repeat;
}

// Whether a filter reads one texel of a level. Undefined is linear.
bool readNearest(ObjectReader& sampler, const char* key, bool minification) {
    const uint64_t value = sampler.optionalInteger(key, 0).value_or(glLinear);
    if (value == glNearest) return true;
    if (value == glLinear) return false;
    if (minification && (value == glNearestMipmapNearest || value == glNearestMipmapLinear)) return true;
    if (minification && (value == glLinearMipmapNearest || value == glLinearMipmapLinear)) return false;
    sampler.fail(key, Json(value), "a filter of glTF");
    return false;
}

Status readSampler(ObjectReader sampler, scene::Material& to) {
    to.wrapU = readWrap(sampler, "wrapS");
    to.wrapV = readWrap(sampler, "wrapT");
    const bool magnified = readNearest(sampler, "magFilter", false);
    const bool minified = readNearest(sampler, "minFilter", true);
    to.filter = magnified == minified ? (magnified ? image::Filter::nearest : image::Filter::linear)
                                      : image::Filter::both;
    return sampler.status();
}

// The extension that gives a texture its only image, for an error.
std::string onlySourceOf(const Json& texture) {
    const Json* extensions = memberOf(texture, "extensions");
    if (extensions == nullptr || !extensions->is_object()) return "";
    for (const auto& [name, value] : extensions->items()) {
        if (value.is_object() && value.contains("source")) return name;
    }
    return "";
}

Status readTexture(const GltfDocument::Data& data, size_t index, scene::Material& to) {
    ObjectReader texture = data.item("textures", index);
    const std::optional<uint64_t> source = texture.optionalIndex("source", data.list("images").size());
    const std::optional<uint64_t> sampler = texture.optionalIndex("sampler", data.list("samplers").size());
    if (const Status status = texture.status(); !status) return status;
    if (!source) {
        const std::string extension = onlySourceOf(data.list("textures")[index]);
        if (extension.empty()) texture.missing("source", "an image");
        if (const Status status = texture.status(); !status) return status;
        return Error{ErrorKind::unsupported,
                     fmt::format("{}: its image is only given by {}, which is not read; add a PNG as source",
                                 texture.path(), extension)};
    }
    to.image = static_cast<int>(*source);
    return sampler ? readSampler(data.item("samplers", *sampler), to) : Status();
}

Status readTextureInfo(const GltfDocument::Data& data, const Json& json, const std::string& path,
                       scene::Material& to, TextureCoordinates& coordinates) {
    ObjectReader info(json, path);
    const size_t texture = info.index("index", data.list("textures").size());
    coordinates.set = info.optionalInteger("texCoord", 0).value_or(0);
    if (const Status status = info.status(); !status) return status;
    if (const Json* extension = extensionOf(json, "KHR_texture_transform")) {
        ObjectReader transform(*extension, path + "/extensions/KHR_texture_transform");
        coordinates.offset = transform.numbers<2>("offset", {0, 0});
        coordinates.scale = transform.numbers<2>("scale", {1, 1});
        coordinates.rotation = transform.number("rotation", 0);
        coordinates.set = transform.optionalInteger("texCoord", 0).value_or(coordinates.set);
        if (const Status status = transform.status(); !status) return status;
    }
    return readTexture(data, texture, to);
}

scene::AlphaMode readAlphaMode(ObjectReader& material) {
    const std::string mode = material.text("alphaMode", "OPAQUE");
    if (mode == "MASK") return scene::AlphaMode::mask;
    if (mode == "BLEND") return scene::AlphaMode::blend;
    if (mode != "OPAQUE") material.fail("alphaMode", Json(mode), "OPAQUE, MASK or BLEND");
    return scene::AlphaMode::opaque;
}

Status readBaseColour(const GltfDocument::Data& data, ObjectReader& material, scene::Material& to,
                      MaterialUse& use) {
    ObjectReader pbr(material.object("pbrMetallicRoughness"), material.pathOf("pbrMetallicRoughness"));
    const std::array<double, 4> factor = pbr.numbers<4>("baseColorFactor", {1, 1, 1, 1});
    for (size_t c = 0; c < 4; ++c) {
        if (!(factor[c] >= 0 && factor[c] <= 1)) {
            pbr.fail("baseColorFactor", Json(factor[c]), "four numbers from 0 to 1");
        }
        to.baseColourFactor[c] = static_cast<float>(factor[c]);
    }
    const Json& info = pbr.object("baseColorTexture");
    if (const Status status = pbr.status(); !status) return status;
    if (!pbr.has("baseColorTexture")) return {};
    return readTextureInfo(data, info, pbr.pathOf("baseColorTexture"), to, use.coordinates);
}

// Everything of a material after its alpha mode.
Status readRest(const GltfDocument::Data& data, ObjectReader& material, scene::Material& to,
                MaterialUse& use) {
    to.cutoff = material.number("alphaCutoff", 0.5, 0);
    to.doubleSided = material.flag("doubleSided", false);
    if (const Status status = readBaseColour(data, material, to, use); !status) return status;
    return material.status();
}

Status readMaterial(SceneReading& reading, size_t index) {
    scene::Material& to = reading.scene.materials[index];
    MaterialUse& use = reading.materials[index];
    ObjectReader material = reading.data.item("materials", index);
    to.alphaMode = readAlphaMode(material);
    to.name = material.text("name", "");
    if (const Status status = material.status(); !status) return status;
    use.needsAlpha = to.alphaMode == scene::AlphaMode::mask ||
                     (to.alphaMode == scene::AlphaMode::blend && reading.options.blendAlpha);
    const Status rest = readRest(reading.data, material, to, use);
    if (rest || (use.needsAlpha && use.used)) return rest;
    reading.note(rest.error().message + " (passed over: its alpha is not needed)");
    to.image = -1;
    return {};
}

// Marks the materials that lists of triangles use.
Status markUsed(SceneReading& reading) {
    const Json& meshes = reading.data.list("meshes");
    for (size_t m = 0; m < meshes.size(); ++m) {
        ObjectReader mesh = reading.data.item("meshes", m);
        const Json& primitives = mesh.array("primitives");
        for (size_t p = 0; p < primitives.size(); ++p) {
            ObjectReader primitive(primitives[p], fmt::format("{}/primitives/{}", mesh.path(), p));
            const std::optional<uint64_t> material =
                primitive.optionalIndex("material", reading.materials.size());
            const bool triangles = primitive.optionalInteger("mode", 0, 6).value_or(4) == 4;
            if (const Status status = primitive.status(); !status) return status;
            if (material && triangles) reading.materials[*material].used = true;
        }
        if (const Status status = mesh.status(); !status) return status;
    }
    return {};
}

}  // namespace

Status readMaterials(SceneReading& reading) {
    const size_t count = reading.data.list("materials").size();
    reading.scene.materials.resize(count);
    reading.materials.resize(count);
    if (const Status status = markUsed(reading); !status) return status;
    for (size_t i = 0; i < count; ++i) {
        if (const Status status = readMaterial(reading, i); !status) return status;
    }
    return {};
}

}  // namespace filigree::io
