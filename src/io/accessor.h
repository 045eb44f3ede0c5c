// Accessors (glTF 2.0 section 3.6.2): typed views of buffers, sparse ones and those without a view included.
#pragma once

#include "io/document.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace filigree::io {

// The numbers of glTF. int32 occurs in EXT_mesh_opacity_micromap only.
enum class ComponentType : uint32_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    int32 = 5124,
    uint32 = 5125,
    float32 = 5126
};

size_t componentBytes(ComponentType type);
bool isSigned(ComponentType type);

// What an accessor says of itself.
struct Accessor {
    std::string path;
    std::optional<uint64_t> bufferView;
    uint64_t byteOffset = 0;
    ComponentType componentType = ComponentType::float32;
    std::string type;         // "SCALAR", "VEC3", ...
    unsigned components = 1;  // of one element
    size_t elementBytes = 4;  // with the padding of matrix columns
    bool normalized = false;
    uint64_t count = 0;  // elements
    bool sparse = false;
};

Result<Accessor> readAccessor(const GltfDocument::Data& data, size_t index);

// Of an accessor without a buffer view, whose count nothing else bounds.
inline constexpr uint64_t maxZeroElements = uint64_t{1} << 24;

// Where an accessor's elements lie, all checked against their buffers.
struct Elements {
    Accessor accessor;
    const uint8_t* first = nullptr;  // null: all zeros
    size_t stride = 0;
    uint64_t sparseCount = 0;
    ComponentType sparseIndexType = ComponentType::uint32;
    const uint8_t* sparseIndices = nullptr;
    const uint8_t* sparseValues = nullptr;
};

// Finds an accessor's elements. Fails when they do not lie in their view, when the view does not lie in its
// buffer, when sparse indices do not rise or pass the end, and with ErrorKind::unsupported on compressed
// views.
Result<Elements> findElements(const GltfDocument::Data& data, size_t index);

// One component as a number; normalized integers as section 3.6.2.2 maps them to [0, 1] or [-1, 1].
double componentAt(const uint8_t* from, ComponentType type, bool normalized);

// The first four components of an element.
using Element = std::array<double, 4>;
Element elementAt(const uint8_t* from, const Accessor& accessor);

// Calls put(i, element) for every element in order, then again for those that a sparse accessor replaces.
template <class Put>
void forEachElement(const Elements& elements, Put&& put) {
    const Accessor& accessor = elements.accessor;
    for (uint64_t i = 0; i < accessor.count; ++i) {
        put(i, elements.first != nullptr ? elementAt(elements.first + i * elements.stride, accessor)
                                         : Element{});
    }
    const size_t indexBytes = componentBytes(elements.sparseIndexType);
    for (uint64_t k = 0; k < elements.sparseCount; ++k) {
        const double i =
            componentAt(elements.sparseIndices + k * indexBytes, elements.sparseIndexType, false);
        put(static_cast<uint64_t>(i), elementAt(elements.sparseValues + k * accessor.elementBytes, accessor));
    }
}

}  // namespace filigree::io
