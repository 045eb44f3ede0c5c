#include "io/micromap_bytes.h"
#include "io/read_parts.h"
#include "io/test_json.h"

#include <fmt/format.h>

namespace filigree::io {
namespace {

Result<std::vector<micromap::Record>> readRecords(const BufferView& view, size_t dataSize,
                                                  const std::string& path) {
    const size_t stride = view.byteStride.value_or(micromap::recordBytes);
    if (stride < micromap::recordBytes ||
        (!view.byteStride && view.bytes.size() % micromap::recordBytes != 0)) {
        return Error{ErrorKind::format,
                     fmt::format("{}: a buffer view of {} bytes and stride {}, expected records of {} bytes",
                                 path, view.bytes.size(), stride, micromap::recordBytes)};
    }
    Result<std::vector<micromap::Record>> records = decodeRecords(view.bytes, stride, dataSize);
    if (!records) return records.error().within(path);
    return records;
}

// What the file says of how it was baked; a note when it says it in a way that is not understood.
void readTest(SceneReading& reading, ObjectReader& micromap, scene::Micromaps& to) {
    const Json& extras = micromap.object("extras");
    const Json* recorded = memberOf(extras, "filigree");
    if (recorded == nullptr) return;
    const Result<image::AlphaTest> test = testFromJson(*recorded, micromap.pathOf("extras/filigree"));
    if (test) {
        to.bakedWith = *test;
    } else {
        reading.note(test.error().message + " (passed over)");
    }
}

Status readMicromap(SceneReading& reading, const Json& json, const std::string& path) {
    ObjectReader reader(json, path);
    const size_t views = reading.data.list("bufferViews").size();
    const size_t data = reader.index("data", views);
    const size_t triangles = reader.index("triangles", views);
    scene::Micromaps to;
    to.name = reader.text("name", "");
    if (const Status status = reader.status(); !status) return status;
    const Result<BufferView> dataView = readBufferView(reading.data, data);
    if (!dataView) return dataView.error().within(reader.pathOf("data"));
    const Result<BufferView> recordView = readBufferView(reading.data, triangles);
    if (!recordView) return recordView.error().within(reader.pathOf("triangles"));
    if (const Status taken = reading.take(dataView->bytes.size() + recordView->bytes.size(), path); !taken)
        return taken;
    Result<std::vector<micromap::Record>> records =
        readRecords(*recordView, dataView->bytes.size(), reader.pathOf("triangles"));
    if (!records) return records.error();
    to.set.records = std::move(*records);
    to.set.data.assign(dataView->bytes.begin(), dataView->bytes.end());
    readTest(reading, reader, to);
    reading.scene.micromaps.push_back(std::move(to));
    return {};
}

// The value of one index: a record of `records` with the base added, or special.
Result<int32_t> checkedIndex(int64_t index, uint64_t base, size_t records) {
    if (index < 0 && index >= -4) return static_cast<int32_t>(index);
    if (index >= 0 && static_cast<uint64_t>(index) + base < records)
        return static_cast<int32_t>(index + static_cast<int64_t>(base));
    return Error{
        ErrorKind::format,
        fmt::format("index {} with base {}, expected -4 to -1 or below {} records", index, base, records)};
}

// Which micromap of the scene a primitive's extension uses, and the records that it has.
struct Link {
    const Json* extension = nullptr;
    std::string path;
    int micromap = -1;
    size_t records = 0;
    uint64_t base = 0;
};

class IndexReader {
  public:
    IndexReader(const Link& link, scene::Primitive& to) : link_(link), to_(to) {
        to_.micromapIndices.resize(to.triangleCount());
    }

    // Without an accessor, triangle t has record t.
    Status countUp() {
        for (size_t t = 0; t < to_.micromapIndices.size(); ++t) put(t, static_cast<int64_t>(t));
        return status();
    }

    Status read(const Elements& elements) {
        const Accessor& accessor = elements.accessor;
        const size_t bytes = componentBytes(accessor.componentType);
        const bool hasSign = isSigned(accessor.componentType);
        forEachElement(elements, [&](uint64_t t, const Element& e) {
            put(t, hasSign ? static_cast<int64_t>(e[0]) : signedIndex(static_cast<uint32_t>(e[0]), bytes));
        });
        return status();
    }

  private:
    void put(size_t triangle, int64_t value) {
        const Result<int32_t> index = checkedIndex(value, link_.base, link_.records);
        if (index) {
            to_.micromapIndices[triangle] = *index;
        } else if (!error_) {
            error_ = index.error().within(fmt::format("{}: triangle {}", link_.path, triangle));
        }
    }
    [[nodiscard]] Status status() const { return error_ ? Status(*error_) : Status(); }

    const Link& link_;
    scene::Primitive& to_;
    std::optional<Error> error_;
};

Result<Elements> findIndices(const GltfDocument::Data& data, size_t index, const Link& link,
                             size_t triangles) {
    Result<Elements> elements = findElements(data, index);
    if (!elements) return elements.error().within(link.path + "/micromapIndices");
    const Accessor& accessor = elements->accessor;
    if (accessor.type != "SCALAR" || accessor.componentType == ComponentType::float32 ||
        accessor.componentType == ComponentType::int8 || accessor.normalized) {
        return Error{
            ErrorKind::format,
            fmt::format("{}/micromapIndices: found {} of component type {}, expected SCALAR of 5121 to 5125",
                        link.path, accessor.type, static_cast<uint32_t>(accessor.componentType))};
    }
    if (accessor.count != triangles) {
        return Error{ErrorKind::format,
                     fmt::format("{}/micromapIndices: {} indices, expected one for each of {} triangles",
                                 link.path, accessor.count, triangles)};
    }
    return elements;
}

Status readLink(SceneReading& reading, Link link, scene::Primitive& to) {
    ObjectReader reader(*link.extension, link.path);
    const std::optional<uint64_t> indices =
        reader.optionalIndex("micromapIndices", reading.data.list("accessors").size());
    link.base = reader.optionalInteger("micromapBaseTriangle", 0, UINT32_MAX).value_or(0);
    if (const Status status = reader.status(); !status) return status;
    link.records = reading.scene.micromaps[static_cast<size_t>(link.micromap)].set.records.size();
    if (to.positions.empty()) {
        reading.note(link.path + ": micromaps of a primitive that was passed over");
        return {};
    }
    if (const Status taken = reading.take(to.triangleCount() * 4, link.path); !taken) return taken;
    to.micromaps = link.micromap;
    if (!indices) return IndexReader(link, to).countUp();
    const Result<Elements> elements = findIndices(reading.data, *indices, link, to.triangleCount());
    return elements ? IndexReader(link, to).read(*elements) : Status(elements.error());
}

}  // namespace

Status readMicromaps(SceneReading& reading) {
    if (!reading.options.micromaps) return {};
    for (size_t n = 0; n < micromapExtensions.size(); ++n) {
        reading.firstMicromaps[n] = reading.scene.micromaps.size();
        const Json* extension = reading.data.rootExtension(micromapExtensions[n]);
        if (extension == nullptr) continue;
        ObjectReader root(*extension, fmt::format("/extensions/{}", micromapExtensions[n]));
        const Json& micromaps = root.array("micromaps");
        if (const Status status = root.status(); !status) return status;
        for (size_t i = 0; i < micromaps.size(); ++i) {
            const std::string path = fmt::format("{}/micromaps/{}", root.path(), i);
            if (const Status status = readMicromap(reading, micromaps[i], path); !status) return status;
        }
    }
    return {};
}

Status readMicromapIndices(SceneReading& reading, const Json& primitive, const std::string& path,
                           scene::Primitive& to) {
    for (size_t n = 0; n < micromapExtensions.size(); ++n) {
        const Json* extension = extensionOf(primitive, micromapExtensions[n]);
        if (extension == nullptr) continue;
        const size_t first = reading.firstMicromaps[n];
        const size_t end = n + 1 < micromapExtensions.size() ? reading.firstMicromaps[n + 1]
                                                             : reading.scene.micromaps.size();
        Link link{extension, fmt::format("{}/extensions/{}", path, micromapExtensions[n]), -1, 0, 0};
        ObjectReader reader(*extension, link.path);
        link.micromap = static_cast<int>(first + reader.index("micromap", end - first));
        if (const Status status = reader.status(); !status) return status;
        return readLink(reading, std::move(link), to);
    }
    return {};
}

}  // namespace filigree::io
