#include "io/document.h"

#include "filigree/core/file.h"

#include "io/uri.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace filigree::io {
namespace {

constexpr std::array<const char*, 14> topLevelLists{
    "accessors",      "animations", "buffers",   "bufferViews", "cameras", "extensionsRequired",
    "extensionsUsed", "images",     "materials", "meshes",      "nodes",   "samplers",
    "scenes",         "textures"};

Status checkRoot(const Json& root) {
    ObjectReader reader(root, "");
    for (const char* key : topLevelLists) reader.array(key);
    if (root.is_object() && !root.contains("asset")) reader.missing("asset", "an object");
    ObjectReader asset(reader.object("asset"), "/asset");
    if (const Status status = reader.status(); !status) return status.error();
    const std::string version = asset.text("version", "");
    if (!version.starts_with("2.")) {
        return Error{ErrorKind::format, fmt::format("/asset/version: found \"{}\", expected 2.0", version)};
    }
    return asset.status();
}

// Reads the buffers of a document, each file once.
class BufferLoader {
  public:
    BufferLoader(GltfDocument::Data& data, std::span<const uint8_t> binary) : data_(data), binary_(binary) {}

    Status load() {
        const size_t count = data_.list("buffers").size();
        data_.buffers.reserve(count);
        for (size_t i = 0; i < count; ++i) {
            ObjectReader reader = data_.item("buffers", i);
            const uint64_t length = reader.integer("byteLength", 1);
            const std::string uri = reader.text("uri", "");
            if (const Status status = reader.status(); !status) return status;
            if (const Status status = add(i, length, uri); !status) return status;
        }
        return {};
    }

  private:
    Status add(size_t index, uint64_t length, const std::string& uri) {
        const std::string path = fmt::format("/buffers/{}", index);
        const Result<std::span<const uint8_t>> found = find(index, uri);
        if (!found) {
            data_.buffers.push_back({{}, found.error().within(path)});
        } else if (found->size() < length) {
            return Error{ErrorKind::format,
                         fmt::format("{}/byteLength: found {}, but the buffer has {} bytes", path, length,
                                     found->size())};
        } else {
            data_.buffers.push_back({found->first(length), std::nullopt});
        }
        return {};
    }

    Result<std::span<const uint8_t>> find(size_t index, const std::string& uri) {
        if (uri.empty()) {
            if (index == 0 && data_.binary) return binary_;
            return Error{ErrorKind::format, "no uri, and not the BIN chunk of a GLB"};
        }
        if (const auto known = files_.find(uri); known != files_.end()) return known->second;
        Result<std::vector<uint8_t>> bytes = isDataUri(uri) ? decodeDataUri(uri) : readSibling(data_, uri);
        if (!bytes) return bytes.error();
        data_.owned.push_back(std::move(*bytes));
        const std::span<const uint8_t> view = data_.owned.back();
        if (!isDataUri(uri)) files_.emplace(uri, view);
        return view;
    }

    GltfDocument::Data& data_;
    std::span<const uint8_t> binary_;
    std::map<std::string, std::span<const uint8_t>> files_;
};

Status loadInto(GltfDocument::Data& data, std::span<const uint8_t> file) {
    Glb glb;
    data.binary = isGlb(file);
    if (data.binary) {
        const Result<Glb> parsed = parseGlb(file);
        if (!parsed) return parsed.error();
        glb = *parsed;
        data.others = glb.others;
    } else {
        glb.json = {reinterpret_cast<const char*>(file.data()), file.size()};
    }
    Result<Json> json = parseJson(glb.json);
    if (!json) return json.error();
    data.json = std::move(*json);
    if (const Status root = checkRoot(data.json); !root) return root;
    return BufferLoader(data, glb.binary).load();
}

}  // namespace

const Json& GltfDocument::Data::list(const char* key) const {
    const Json* found = memberOf(json, key);
    return found != nullptr ? *found : emptyArray();
}

ObjectReader GltfDocument::Data::item(const char* key, size_t index) const {
    return {list(key)[index], fmt::format("/{}/{}", key, index)};
}

const Json* GltfDocument::Data::rootExtension(const char* extension) const {
    return extensionOf(json, extension);
}

const Json* memberOf(const Json& object, std::string_view key) {
    if (!object.is_object()) return nullptr;
    const auto it = object.find(key);
    return it == object.end() ? nullptr : &*it;
}

const Json* extensionOf(const Json& owner, const char* extension) {
    const Json* extensions = memberOf(owner, "extensions");
    return extensions != nullptr ? memberOf(*extensions, extension) : nullptr;
}

bool listsExtension(const Json& document, const char* key, std::string_view extension) {
    const Json* names = memberOf(document, key);
    if (names == nullptr || !names->is_array()) return false;
    return std::any_of(names->begin(), names->end(), [&](const Json& name) {
        return name.is_string() && name.get_ref<const std::string&>() == extension;
    });
}

Result<BufferView> readBufferView(const GltfDocument::Data& data, size_t index) {
    ObjectReader reader = data.item("bufferViews", index);
    BufferView view;
    view.buffer = reader.index("buffer", data.buffers.size());
    const uint64_t offset = reader.optionalInteger("byteOffset", 0).value_or(0);
    const uint64_t length = reader.integer("byteLength", 1);
    view.byteStride = reader.optionalInteger("byteStride", 4, 252);
    if (const Status status = reader.status(); !status) return status.error();
    for (const char* compression : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        if (extensionOf(data.list("bufferViews")[index], compression) != nullptr) {
            return Error{ErrorKind::unsupported,
                         fmt::format("{}: compressed with {}, which is not read; decompress the file first",
                                     reader.path(), compression)};
        }
    }
    const Buffer& buffer = data.buffers[view.buffer];
    if (buffer.missing) return buffer.missing->within(reader.path());
    if (offset > buffer.bytes.size() || length > buffer.bytes.size() - offset) {
        return Error{ErrorKind::format,
                     fmt::format("{}: bytes {} to {} of buffer {}, which has {} bytes", reader.path(), offset,
                                 offset + length, view.buffer, buffer.bytes.size())};
    }
    view.bytes = buffer.bytes.subspan(offset, length);
    return view;
}

Result<std::vector<uint8_t>> readSibling(const GltfDocument::Data& data, std::string_view uri) {
    const Result<std::filesystem::path> relative = pathOfUri(uri);
    if (!relative) return relative.error();
    const std::filesystem::path path = data.folder / *relative;
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
        return Error{ErrorKind::file, path.string() + ": expected a regular file"};
    }
    return readFile(path);
}

GltfDocument::GltfDocument(std::unique_ptr<Data> data) : data_(std::move(data)) {}
GltfDocument::GltfDocument(GltfDocument&&) noexcept = default;
GltfDocument& GltfDocument::operator=(GltfDocument&&) noexcept = default;
GltfDocument::~GltfDocument() = default;

const std::string& GltfDocument::name() const {
    return data_->name;
}

Result<GltfDocument> GltfDocument::parse(std::vector<uint8_t> bytes, const std::filesystem::path& baseFolder,
                                         const std::string& name) {
    Result<GltfDocument> document = view(bytes, baseFolder, name);
    if (document && document->data_->binary) document->data_->file = std::move(bytes);
    return document;
}

Result<GltfDocument> GltfDocument::view(std::span<const uint8_t> bytes,
                                        const std::filesystem::path& baseFolder, const std::string& name) {
    auto data = std::make_unique<Data>();
    data->name = name;
    data->folder = baseFolder;
    if (const Status status = loadInto(*data, bytes); !status) return status.error().within(name);
    return GltfDocument(std::move(data));
}

Result<GltfDocument> GltfDocument::load(const std::filesystem::path& path) {
    Result<std::vector<uint8_t>> bytes = readFile(path, UINT32_MAX);
    if (!bytes) return bytes.error();
    return parse(std::move(*bytes), path.parent_path(), path.string());
}

}  // namespace filigree::io
