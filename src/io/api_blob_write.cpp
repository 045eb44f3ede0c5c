#include "filigree/core/file.h"
#include "filigree/io/api_blob.h"

#include "io/api_blob.h"
#include "io/micromap_bytes.h"
#include "io/output_check.h"
#include "io/test_json.h"

#include <algorithm>
#include <functional>
#include <system_error>

#include <fmt/format.h>

namespace filigree::io {
namespace {

namespace fs = std::filesystem;

Error folderError(const fs::path& folder, std::string_view what, const std::error_code& code) {
    return {ErrorKind::file, fmt::format("{}: {}: {}", folder.string(), what, code.message())};
}

// Gives one blob after the other to where they go; the first failure sticks.
class BlobWriter {
  public:
    using Sink = std::function<Status(const std::string& name, std::span<const uint8_t> bytes)>;
    explicit BlobWriter(Sink sink) : sink_(std::move(sink)) {}

    // Writes a file and describes it.
    Json file(const std::string& name, std::span<const uint8_t> bytes) {
        if (status_) status_ = sink_(name, bytes);
        Json json = Json::object();
        json["file"] = name;
        json["bytes"] = bytes.size();
        return json;
    }
    void manifest(const Json& json) {
        const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
        const std::span bytes(reinterpret_cast<const uint8_t*>(text.data()), text.size());
        if (status_) status_ = sink_(manifestName, bytes);
    }
    [[nodiscard]] const Status& status() const { return status_; }

  private:
    Sink sink_;
    Status status_;
};

Json micromapManifest(const OutputMicromaps& item, size_t number, BlobWriter& writer) {
    Json json = Json::object();
    json["name"] = item.name;
    json["data"] = writer.file(fmt::format("micromap_{}.data.bin", number), item.set->data);
    json["data"]["alignment"] = blobAlignment;
    json["records"] =
        writer.file(fmt::format("micromap_{}.records.bin", number), encodeRecords(item.set->records));
    json["records"]["alignment"] = blobAlignment;
    json["records"]["stride"] = micromap::recordBytes;
    json["records"]["count"] = item.set->records.size();
    json["usageCounts"] = usageToJson(micromap::usageCounts(item.set->records));
    if (item.test) json["test"] = testToJson(*item.test);
    return json;
}

Json indexManifest(const OutputPrimitive& item, const std::string& stem, BlobWriter& writer) {
    const size_t bytes = micromap::indexBytes(item.indices);
    const auto type =
        std::find_if(indexTypes.begin(), indexTypes.end(), [&](const auto& t) { return t.bytes == bytes; });
    Json json = writer.file(stem + ".indices.bin", encodeIndices(item.indices, bytes));
    json["stride"] = bytes;
    json["vulkanIndexType"] = type->vulkan;
    json["dxgiFormat"] = type->dxgi;
    return json;
}

Json primitiveManifest(const OutputPrimitive& item, const MicromapOutput& output, BlobWriter& writer) {
    const std::string stem = fmt::format("mesh_{}_primitive_{}", item.mesh, item.primitive);
    Json json = Json::object();
    json["mesh"] = item.mesh;
    json["primitive"] = item.primitive;
    json["micromap"] = item.micromaps;
    json["triangles"] = item.indices.size();
    json["indices"] = indexManifest(item, stem, writer);
    json["baseTriangle"] = 0;
    json["usageCounts"] =
        usageToJson(micromap::usageByTriangles(item.indices, output.micromaps[item.micromaps].set->records));
    if (item.vertexIndices.empty()) return json;
    const std::span<const int32_t> vertices(reinterpret_cast<const int32_t*>(item.vertexIndices.data()),
                                            item.vertexIndices.size());
    json["vertexIndices"] = writer.file(stem + ".vertices.bin", encodeIndices(vertices, 4));
    json["vertexIndices"]["stride"] = 4;
    return json;
}

Status writeInto(const BlobWriter::Sink& sink, const MicromapOutput& output, const std::string& source) {
    if (const Status agrees = checkOutput(output); !agrees) return agrees;
    BlobWriter writer(sink);
    Json manifest = Json::object();
    manifest["format"] = blobFormat;
    manifest["version"] = blobVersion;
    manifest["source"] = source;
    manifest["micromaps"] = Json::array();
    manifest["primitives"] = Json::array();
    for (size_t i = 0; i < output.micromaps.size(); ++i) {
        manifest["micromaps"].push_back(micromapManifest(output.micromaps[i], i, writer));
    }
    for (const OutputPrimitive& item : output.primitives) {
        manifest["primitives"].push_back(primitiveManifest(item, output, writer));
    }
    writer.manifest(manifest);
    return writer.status();
}

// A new empty folder beside `folder`.
Result<fs::path> makeBeside(const fs::path& folder) {
    std::error_code code;
    for (unsigned i = 0; i < 1000; ++i) {
        fs::path path = folder.string() + fmt::format(".partial{}", i);
        if (fs::create_directory(path, code)) return path;
        if (code) return folderError(path, "cannot write", code);
    }
    return Error{ErrorKind::file,
                 folder.string() + ": too many unfinished folders beside it, remove *.partial*"};
}

// True for a folder that an earlier call wrote.
bool holdsBlobs(const fs::path& folder) {
    const Result<std::vector<uint8_t>> text = readFile(folder / manifestName, uint64_t{1} << 30);
    if (!text) return false;
    const Result<Json> manifest = parseJson({reinterpret_cast<const char*>(text->data()), text->size()});
    return manifest && manifest->is_object() && manifest->value("format", Json()) == Json(blobFormat);
}

// Puts `fresh` where `folder` is, an earlier folder of blobs or nothing.
Status replaceFolder(const fs::path& fresh, const fs::path& folder) {
    std::error_code code;
    if (!fs::exists(folder, code) || fs::is_empty(folder, code)) {
        fs::rename(fresh, folder, code);
        return code ? Status(folderError(folder, "cannot write", code)) : Status();
    }
    const fs::path old = fresh.string() + ".old";
    fs::rename(folder, old, code);
    if (code) return folderError(folder, "cannot replace", code);
    fs::rename(fresh, folder, code);
    if (code) {
        std::error_code ignored;
        fs::rename(old, folder, ignored);
        return folderError(folder, "cannot replace", code);
    }
    fs::remove_all(old, code);
    return {};
}

}  // namespace

Json usageToJson(const std::vector<micromap::UsageCount>& usages) {
    Json json = Json::array();
    for (const micromap::UsageCount& usage : usages) {
        Json entry = Json::object();
        entry["count"] = usage.count;
        entry["subdivisionLevel"] = usage.level;
        entry["format"] = static_cast<unsigned>(usage.format);
        json.push_back(std::move(entry));
    }
    return json;
}

Result<std::vector<ApiBlob>> encodeApiBlobs(const MicromapOutput& output, const std::string& source) {
    std::vector<ApiBlob> blobs;
    const auto toList = [&](const std::string& name, std::span<const uint8_t> bytes) {
        blobs.push_back({name, {bytes.begin(), bytes.end()}});
        return Status();
    };
    if (const Status status = writeInto(toList, output, source); !status) return status.error();
    return blobs;
}

Status writeApiBlobs(const fs::path& given, const MicromapOutput& output, const std::string& source) {
    fs::path folder = given.lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();  // "blobs/"
    std::error_code code;
    if (fs::exists(folder, code) &&
        !(fs::is_directory(folder, code) && (fs::is_empty(folder, code) || holdsBlobs(folder)))) {
        return Error{ErrorKind::file, folder.string() + ": exists and holds other things; name a new folder"};
    }
    const Result<fs::path> fresh = makeBeside(folder);
    if (!fresh) return fresh.error();
    const auto toFile = [&](const std::string& name, std::span<const uint8_t> bytes) {
        return writeFile(*fresh / name, bytes);
    };
    Status status = writeInto(toFile, output, source);
    if (status) status = replaceFolder(*fresh, folder);
    if (!status) fs::remove_all(*fresh, code);
    return status;
}

}  // namespace filigree::io
