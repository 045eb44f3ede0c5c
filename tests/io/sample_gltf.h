// Small glTF files made in code.
#pragma once

#include "filigree/io/gltf.h"
#include "filigree/io/gltf_write.h"

#include "io/json.h"

#include <cstdint>
#include <string>
#include <vector>

namespace filigree::tests {

// A glTF document under construction: JSON and one buffer.
struct SampleGltf {
    io::Json json;
    std::vector<uint8_t> buffer;

    // A quad of two triangles with a MASK material over a 4 x 4 PNG, placed once.
    static SampleGltf maskedQuad();

    // Appends values and a buffer view of them; returns the view's index.
    template <class T>
    size_t view(const std::vector<T>& values) {
        const auto* bytes = reinterpret_cast<const uint8_t*>(values.data());
        return viewOfBytes({bytes, bytes + values.size() * sizeof(T)});
    }
    size_t viewOfBytes(const std::vector<uint8_t>& bytes);

    // An accessor of a view of `values`; returns the accessor's index.
    template <class T>
    size_t accessor(const std::vector<T>& values, unsigned componentType, const std::string& type,
                    size_t count) {
        json["accessors"].push_back({{"bufferView", view(values)},
                                     {"componentType", componentType},
                                     {"count", count},
                                     {"type", type}});
        return json["accessors"].size() - 1;
    }

    io::Json& primitive() { return json["meshes"][0]["primitives"][0]; }
    io::Json& material() { return json["materials"][0]; }

    [[nodiscard]] std::vector<uint8_t> glb() const;
    [[nodiscard]] std::string gltf() const;  // with the buffer as a data URI

    [[nodiscard]] Result<io::GltfDocument> parse() const {
        return io::GltfDocument::parse(glb(), "", "sample.glb");
    }
    [[nodiscard]] Result<scene::Scene> read(const io::ReadOptions& options = {}) const;
};

// A 4 x 4 RGBA PNG whose left half is transparent.
std::vector<uint8_t> samplePng();

// One record of `level` in four states, with data that counts up.
micromap::FlatSet sampleSet(unsigned level, size_t records = 1);

// The micromaps of `set` on the quad of `maskedQuad`.
std::vector<uint8_t> sampleWithMicromaps();

}  // namespace filigree::tests
