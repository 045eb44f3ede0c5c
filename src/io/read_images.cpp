#include "filigree/io/image_file.h"

#include "io/read_parts.h"
#include "io/uri.h"

#include <fmt/format.h>

namespace filigree::io {
namespace {

struct ImageUse {
    bool alpha = false;
    bool colour = false;
};

std::vector<ImageUse> imageUses(const SceneReading& reading) {
    std::vector<ImageUse> uses(reading.scene.images.size());
    for (size_t i = 0; i < reading.materials.size(); ++i) {
        const int image = reading.scene.materials[i].image;
        if (image < 0 || !reading.materials[i].used) continue;
        uses[static_cast<size_t>(image)].alpha |= reading.materials[i].needsAlpha;
        uses[static_cast<size_t>(image)].colour |= reading.options.colour;
    }
    return uses;
}

Status decodeAlphaOf(SceneReading& reading, std::span<const uint8_t> bytes, const std::string& path,
                     scene::Image& to) {
    const Result<ImageSize> size = imageSize(bytes);
    if (!size) return size.error().within(path);
    if (const Status taken = reading.take(size->texels() * sizeof(uint16_t), path); !taken) return taken;
    Result<image::AlphaImage> alpha = decodeAlpha(bytes);
    if (!alpha) return alpha.error().within(path);
    to.alpha = std::move(*alpha);
    return {};
}

Status decodeColourOf(SceneReading& reading, std::span<const uint8_t> bytes, const std::string& path,
                      scene::Image& to) {
    const Result<ImageSize> size = imageSize(bytes);
    if (!size) return size.error().within(path);
    if (const Status taken = reading.take(size->texels() * 4, path); !taken) return taken;
    Result<scene::ColourImage> colour = decodeImage(bytes);
    if (!colour) return colour.error().within(path);
    to.colour = std::move(*colour);
    return {};
}

Status readImage(SceneReading& reading, size_t index, ImageUse use) {
    scene::Image& to = reading.scene.images[index];
    const std::string path = fmt::format("/images/{}", index);
    std::vector<uint8_t> owned;
    const Result<std::span<const uint8_t>> bytes = imageBytes(reading.data, index, owned);
    if (use.alpha) {
        if (!bytes) return bytes.error();
        if (const Status status = decodeAlphaOf(reading, *bytes, path, to); !status) return status;
    }
    if (use.colour) {
        const Status status = bytes ? decodeColourOf(reading, *bytes, path, to) : Status(bytes.error());
        if (!status && status.error().kind == ErrorKind::limit) return status;
        if (!status) reading.note(status.error().message + " (its colour is passed over)");
    }
    return {};
}

}  // namespace

Result<std::span<const uint8_t>> imageBytes(const GltfDocument::Data& data, size_t index,
                                            std::vector<uint8_t>& owned) {
    ObjectReader reader = data.item("images", index);
    const std::optional<uint64_t> view = reader.optionalIndex("bufferView", data.list("bufferViews").size());
    const std::string uri = reader.text("uri", "");
    if (!view && uri.empty()) reader.missing("bufferView", "a buffer view or a uri");
    if (const Status status = reader.status(); !status) return status.error();
    if (view) {
        const Result<BufferView> found = readBufferView(data, *view);
        if (!found) return found.error().within(reader.path());
        return found->bytes;
    }
    Result<std::vector<uint8_t>> bytes = isDataUri(uri) ? decodeDataUri(uri) : readSibling(data, uri);
    if (!bytes) return bytes.error().within(reader.path());
    owned = std::move(*bytes);
    return std::span<const uint8_t>(owned);
}

Status readImages(SceneReading& reading) {
    const Json& images = reading.data.list("images");
    reading.scene.images.resize(images.size());
    const std::vector<ImageUse> uses = imageUses(reading);
    for (size_t i = 0; i < images.size(); ++i) {
        const Json* name = memberOf(images[i], "name");
        reading.scene.images[i].name =
            name != nullptr && name->is_string() ? name->get<std::string>() : fmt::format("image {}", i);
        if (!uses[i].alpha && !uses[i].colour) continue;
        if (const Status status = readImage(reading, i, uses[i]); !status) return status;
    }
    return {};
}

}  // namespace filigree::io
