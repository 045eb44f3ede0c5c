#include "io/accessor.h"

#include "filigree/core/bytes.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

namespace filigree::io {
namespace {

struct ElementType {
    std::string_view name;
    unsigned components;
    unsigned columns;  // of a matrix, each padded to 4 bytes; 1 otherwise
};
constexpr std::array<ElementType, 7> elementTypes{{{"SCALAR", 1, 1},
                                                   {"VEC2", 2, 1},
                                                   {"VEC3", 3, 1},
                                                   {"VEC4", 4, 1},
                                                   {"MAT2", 4, 2},
                                                   {"MAT3", 9, 3},
                                                   {"MAT4", 16, 4}}};

size_t bytesOf(const ElementType& type, size_t component) {
    if (type.columns == 1) return type.components * component;
    const size_t column = type.components / type.columns * component;
    return (column + 3) / 4 * 4 * type.columns;
}

void setElementType(Accessor& accessor, ObjectReader& reader) {
    accessor.type = reader.text("type", "");
    const auto type = std::find_if(elementTypes.begin(), elementTypes.end(),
                                   [&](const ElementType& t) { return t.name == accessor.type; });
    if (type == elementTypes.end()) return reader.fail("type", Json(accessor.type), "SCALAR, VEC2 ... MAT4");
    accessor.components = type->components;
    accessor.elementBytes = bytesOf(*type, componentBytes(accessor.componentType));
}

// True when `count` elements, `stride` apart from `offset` on, end inside `size` bytes. Counts and offsets
// are below 2^53 and strides below 2^8, so nothing overflows.
bool fits(uint64_t offset, uint64_t count, uint64_t stride, uint64_t element, uint64_t size) {
    return offset + (count - 1) * stride + element <= size;
}

// A dense run of `count` elements in a view that a sparse accessor names.
Result<const uint8_t*> findRun(const GltfDocument::Data& data, ObjectReader& reader, uint64_t count,
                               size_t element) {
    const size_t view = reader.index("bufferView", data.list("bufferViews").size());
    const uint64_t offset = reader.optionalInteger("byteOffset", 0).value_or(0);
    if (const Status status = reader.status(); !status) return status.error();
    const Result<BufferView> found = readBufferView(data, view);
    if (!found) return found.error().within(reader.path());
    if (!fits(offset, count, element, element, found->bytes.size())) {
        return Error{ErrorKind::format,
                     fmt::format("{}: {} elements do not fit into buffer view {} of {} bytes", reader.path(),
                                 count, view, found->bytes.size())};
    }
    return found->bytes.data() + offset;
}

Status checkSparseIndices(const Elements& elements) {
    const size_t bytes = componentBytes(elements.sparseIndexType);
    double before = -1;
    for (uint64_t k = 0; k < elements.sparseCount; ++k) {
        const double i = componentAt(elements.sparseIndices + k * bytes, elements.sparseIndexType, false);
        if (i <= before || i >= static_cast<double>(elements.accessor.count)) {
            return Error{ErrorKind::format,
                         fmt::format("{}/sparse/indices: entry {} is {}, expected to rise and stay below {}",
                                     elements.accessor.path, k, i, elements.accessor.count)};
        }
        before = i;
    }
    return {};
}

Status findSparse(const GltfDocument::Data& data, const Json& sparse, Elements& elements) {
    ObjectReader reader(sparse, elements.accessor.path + "/sparse");
    elements.sparseCount = reader.integer("count", 1, elements.accessor.count);
    ObjectReader indices(reader.object("indices"), reader.pathOf("indices"));
    ObjectReader values(reader.object("values"), reader.pathOf("values"));
    if (const Status status = reader.status(); !status) return status;
    const uint64_t type = indices.integer("componentType", 5121, 5125);
    if (type != 5121 && type != 5123 && type != 5125)
        indices.fail("componentType", Json(type), "5121, 5123 or 5125");
    if (const Status status = indices.status(); !status) return status;
    elements.sparseIndexType = static_cast<ComponentType>(type);
    const Result<const uint8_t*> where =
        findRun(data, indices, elements.sparseCount, componentBytes(elements.sparseIndexType));
    if (!where) return where.error();
    const Result<const uint8_t*> what =
        findRun(data, values, elements.sparseCount, elements.accessor.elementBytes);
    if (!what) return what.error();
    elements.sparseIndices = *where;
    elements.sparseValues = *what;
    return checkSparseIndices(elements);
}

Status findDense(const GltfDocument::Data& data, Elements& elements) {
    const Accessor& accessor = elements.accessor;
    const Result<BufferView> view = readBufferView(data, *accessor.bufferView);
    if (!view) return view.error().within(accessor.path);
    elements.stride = view->byteStride.value_or(accessor.elementBytes);
    if (elements.stride < accessor.elementBytes) {
        return Error{ErrorKind::format,
                     fmt::format("{}: elements of {} bytes in buffer view {} of stride {}", accessor.path,
                                 accessor.elementBytes, *accessor.bufferView, elements.stride)};
    }
    if (!fits(accessor.byteOffset, accessor.count, elements.stride, accessor.elementBytes,
              view->bytes.size())) {
        return Error{
            ErrorKind::format,
            fmt::format("{}: {} elements of {} bytes from byte {} pass the end of buffer view {}, {} bytes",
                        accessor.path, accessor.count, accessor.elementBytes, accessor.byteOffset,
                        *accessor.bufferView, view->bytes.size())};
    }
    elements.first = view->bytes.data() + accessor.byteOffset;
    return {};
}

}  // namespace

size_t componentBytes(ComponentType type) {
    switch (type) {
        case ComponentType::int8:
        case ComponentType::uint8:
            return 1;
        case ComponentType::int16:
        case ComponentType::uint16:
            return 2;
        default:
            return 4;
    }
}

bool isSigned(ComponentType type) {
    return type == ComponentType::int8 || type == ComponentType::int16 || type == ComponentType::int32;
}

Result<Accessor> readAccessor(const GltfDocument::Data& data, size_t index) {
    ObjectReader reader = data.item("accessors", index);
    Accessor accessor;
    accessor.path = reader.path();
    accessor.bufferView = reader.optionalIndex("bufferView", data.list("bufferViews").size());
    accessor.byteOffset = reader.optionalInteger("byteOffset", 0).value_or(0);
    accessor.componentType = static_cast<ComponentType>(reader.integer("componentType", 5120, 5126));
    accessor.normalized = reader.flag("normalized", false);
    accessor.count = reader.integer("count", 1);
    setElementType(accessor, reader);
    accessor.sparse = reader.has("sparse");
    if (const Status status = reader.status(); !status) return status.error();
    return accessor;
}

Result<Elements> findElements(const GltfDocument::Data& data, size_t index) {
    const Result<Accessor> accessor = readAccessor(data, index);
    if (!accessor) return accessor.error();
    Elements elements;
    elements.accessor = *accessor;
    if (!accessor->bufferView && accessor->count > maxZeroElements) {
        return Error{ErrorKind::limit,
                     fmt::format("{}/count: {} elements without a buffer view, at most {} are read",
                                 accessor->path, accessor->count, maxZeroElements)};
    }
    if (accessor->bufferView) {
        if (const Status dense = findDense(data, elements); !dense) return dense.error();
    }
    if (accessor->sparse) {
        const Json& sparse = *memberOf(data.list("accessors")[index], "sparse");
        if (const Status found = findSparse(data, sparse, elements); !found) return found.error();
    }
    return elements;
}

double componentAt(const uint8_t* from, ComponentType type, bool normalized) {
    switch (type) {
        case ComponentType::int8: {
            const auto value = static_cast<double>(static_cast<int8_t>(*from));
            return normalized ? std::max(value / 127, -1.0) : value;
        }
        case ComponentType::uint8:
            return normalized ? *from / 255.0 : *from;
        case ComponentType::int16: {
            const auto value = static_cast<double>(static_cast<int16_t>(loadLe<uint16_t>(from)));
            return normalized ? std::max(value / 32767, -1.0) : value;
        }
        case ComponentType::uint16: {
            const double value = loadLe<uint16_t>(from);
            return normalized ? value / 65535 : value;
        }
        case ComponentType::int32:
            return static_cast<int32_t>(loadLe<uint32_t>(from));
        case ComponentType::uint32:
            return loadLe<uint32_t>(from);
        default:
            return static_cast<double>(std::bit_cast<float>(loadLe<uint32_t>(from)));
    }
}

Element elementAt(const uint8_t* from, const Accessor& accessor) {
    Element element{};
    const size_t step = componentBytes(accessor.componentType);
    for (size_t c = 0; c < std::min<size_t>(4, accessor.components); ++c) {
        element[c] = componentAt(from + c * step, accessor.componentType, accessor.normalized);
    }
    return element;
}

}  // namespace filigree::io
