#include "filigree/core/file.h"
#include "filigree/io/api_blob.h"

#include "io/accessor.h"
#include "io/api_blob.h"
#include "io/micromap_bytes.h"
#include "io/test_json.h"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>

namespace filigree::io {
namespace {

namespace fs = std::filesystem;

// The bytes of a file by its name, none where there is no such file.
using BlobSource = std::function<std::optional<Result<std::vector<uint8_t>>>(const std::string& name)>;

class BlobCheck {
  public:
    explicit BlobCheck(BlobSource source) : source_(std::move(source)) {}

    void run(const Json& manifest) {
        ObjectReader reader(manifest, "");
        if (reader.text("format", "") != blobFormat) reader.missing("format", "\"filigree-raw\"");
        reader.integer("version", blobVersion, blobVersion);
        const Json& micromaps = reader.array("micromaps");
        const Json& primitives = reader.array("primitives");
        if (!tellOf(reader, "raw-manifest")) return;
        for (size_t i = 0; i < micromaps.size(); ++i) {
            checkMicromap(micromaps[i], fmt::format("/micromaps/{}", i));
        }
        for (size_t i = 0; i < primitives.size(); ++i) {
            checkPrimitive(primitives[i], fmt::format("/primitives/{}", i));
        }
    }

    std::vector<Breach> take() && { return std::move(breaches_); }

  private:
    // The records of one micromap; nothing where they cannot be read.
    using Records = std::optional<std::vector<micromap::Record>>;

    void tell(std::string path, const char* rule, std::string message) {
        breaches_.push_back({std::move(path), rule, std::move(message)});
    }

    // Reports what a reader found wrong; true when nothing.
    bool tellOf(const ObjectReader& reader, const char* rule) {
        const Status status = reader.status();
        if (status) return true;
        const std::string& message = status.error().message;
        const size_t colon = message.find(": ");
        tell(message.substr(0, colon), rule,
             colon == std::string::npos ? message : message.substr(colon + 2));
        return false;
    }

    // The bytes of a file that the manifest describes, of the size that it states.
    std::optional<std::vector<uint8_t>> blob(ObjectReader& owner, const char* key) {
        ObjectReader reader(owner.object(key), owner.pathOf(key));
        const std::string name = reader.text("file", "");
        const uint64_t bytes = reader.integer("bytes", 0);
        if (!tellOf(owner, "raw-manifest") || !tellOf(reader, "raw-manifest")) return std::nullopt;
        const bool isName = !name.empty() && name.find('/') == std::string::npos;
        auto found = isName ? source_(name) : std::nullopt;
        if (!found) {
            tell(reader.pathOf("file"), "raw-file", fmt::format("\"{}\" is no file of this folder", name));
            return std::nullopt;
        }
        if (*found && (*found)->size() == bytes) return std::move(**found);
        tell(reader.pathOf("file"), "raw-file",
             *found ? fmt::format("{} has {} bytes, expected {}", name, (*found)->size(), bytes)
                    : found->error().message);
        return std::nullopt;
    }

    void checkMicromap(const Json& json, const std::string& path) {
        ObjectReader reader(json, path);
        const auto data = blob(reader, "data");
        const auto bytes = blob(reader, "records");
        records_.emplace_back();
        if (reader.has("test")) checkTest(reader);
        if (!data || !bytes) return;
        if (bytes->empty() || bytes->size() % micromap::recordBytes != 0) {
            return tell(path + "/records", "raw-records",
                        fmt::format("{} bytes, expected records of 8 bytes, at least one", bytes->size()));
        }
        Result<std::vector<micromap::Record>> records =
            decodeRecords(*bytes, micromap::recordBytes, data->size());
        if (!records) return tell(path + "/records", "raw-records", records.error().message);
        if (const auto overlap = findOverlap(*records)) {
            tell(path + "/records", "raw-record-overlap",
                 fmt::format("records {} and {} share bytes of data", overlap->first, overlap->second));
        }
        checkUsage(reader, micromap::usageCounts(*records));
        records_.back() = std::move(*records);
    }

    void checkTest(ObjectReader& reader) {
        const Result<image::AlphaTest> test = testFromJson(reader.object("test"), reader.pathOf("test"));
        if (!test) tell(reader.pathOf("test"), "raw-test", test.error().message);
    }

    void checkUsage(ObjectReader& reader, const std::vector<micromap::UsageCount>& expected) {
        if (reader.array("usageCounts") == usageToJson(expected)) return;
        tell(reader.pathOf("usageCounts"), "raw-usage",
             "differ from the counts by level and format: expected " + usageToJson(expected).dump());
    }

    void checkPrimitive(const Json& json, const std::string& path) {
        ObjectReader reader(json, path);
        const size_t micromap = reader.index("micromap", records_.size());
        const uint64_t triangles = reader.integer("triangles", 0);
        reader.integer("baseTriangle", 0, 0);
        if (!tellOf(reader, "raw-manifest")) return;
        const auto bytes = blob(reader, "indices");
        if (!bytes) return;
        const std::optional<size_t> stride = indexType(reader.object("indices"), reader.pathOf("indices"));
        if (!stride) return;
        if (bytes->size() != triangles * *stride) {
            return tell(path + "/indices", "raw-index-count",
                        fmt::format("{} bytes, expected {} for each of {} triangles", bytes->size(), *stride,
                                    triangles));
        }
        if (records_[micromap]) checkIndices(reader, *bytes, *stride, *records_[micromap]);
        if (reader.has("vertexIndices")) checkVertices(reader, triangles);
    }

    std::optional<size_t> indexType(const Json& json, const std::string& path) {
        ObjectReader reader(json, path);
        const uint64_t stride = reader.integer("stride", 1, 4);
        const std::string vulkan = reader.text("vulkanIndexType", "");
        const std::string dxgi = reader.text("dxgiFormat", "");
        if (!tellOf(reader, "raw-manifest")) return std::nullopt;
        const bool known = std::any_of(indexTypes.begin(), indexTypes.end(), [&](const IndexTypeNames& type) {
            return type.bytes == stride && vulkan == type.vulkan && dxgi == type.dxgi;
        });
        if (known) return stride;
        tell(path, "raw-index-type",
             fmt::format("stride {}, {} and {} do not belong together", stride, vulkan, dxgi));
        return std::nullopt;
    }

    void checkIndices(ObjectReader& reader, const std::vector<uint8_t>& bytes, size_t stride,
                      const std::vector<micromap::Record>& records) {
        constexpr std::array<ComponentType, 5> types{ComponentType::uint8, ComponentType::uint8,
                                                     ComponentType::uint16, ComponentType::uint16,
                                                     ComponentType::uint32};
        std::vector<int32_t> indices;
        for (size_t at = 0; at < bytes.size(); at += stride) {
            const double raw = componentAt(bytes.data() + at, types[stride], false);
            const int64_t index = signedIndex(static_cast<uint32_t>(raw), stride);
            if (index >= static_cast<int64_t>(records.size())) {
                return tell(reader.pathOf("indices"), "raw-index-value",
                            fmt::format("triangle {}: {}, expected -4 to -1 or below {} records", at / stride,
                                        index, records.size()));
            }
            indices.push_back(static_cast<int32_t>(index));
        }
        checkUsage(reader, micromap::usageByTriangles(indices, records));
    }

    void checkVertices(ObjectReader& reader, uint64_t triangles) {
        const auto bytes = blob(reader, "vertexIndices");
        if (!bytes || bytes->size() == triangles * 12) return;
        tell(reader.pathOf("vertexIndices"), "raw-vertices",
             fmt::format("{} bytes, expected 12 for each of {} triangles", bytes->size(), triangles));
    }

    BlobSource source_;
    std::vector<Breach> breaches_;
    std::vector<Records> records_;
};

Result<std::vector<Breach>> checkManifest(std::span<const uint8_t> text, const std::string& name,
                                          BlobSource source) {
    const Result<Json> manifest = parseJson({reinterpret_cast<const char*>(text.data()), text.size()});
    if (!manifest) return manifest.error().within(name);
    BlobCheck check(std::move(source));
    check.run(*manifest);
    return std::move(check).take();
}

}  // namespace

Result<std::vector<Breach>> checkApiBlobs(const fs::path& folder) {
    const fs::path path = folder / manifestName;
    const Result<std::vector<uint8_t>> text = readFile(path, uint64_t{1} << 30);
    if (!text) return text.error();
    return checkManifest(*text, path.string(),
                         [&](const std::string& name) -> std::optional<Result<std::vector<uint8_t>>> {
                             std::error_code ignored;
                             if (!fs::is_regular_file(folder / name, ignored)) return std::nullopt;
                             return readFile(folder / name);
                         });
}

Result<std::vector<Breach>> checkApiBlobs(std::span<const ApiBlob> blobs) {
    const auto find = [&](const std::string& name) { return std::ranges::find(blobs, name, &ApiBlob::name); };
    const auto text = find(manifestName);
    if (text == blobs.end())
        return Error{ErrorKind::format, fmt::format("no {} among {} blobs", manifestName, blobs.size())};
    return checkManifest(text->bytes, manifestName,
                         [&](const std::string& name) -> std::optional<Result<std::vector<uint8_t>>> {
                             const auto found = find(name);
                             if (found == blobs.end()) return std::nullopt;
                             return found->bytes;
                         });
}

}  // namespace filigree::io
