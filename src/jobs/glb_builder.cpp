#include "jobs/glb_builder.h"

#include "filigree/core/bytes.h"
#include "filigree/io/image_file.h"

#include <algorithm>
#include <bit>

namespace filigree::jobs {
namespace {

// Numbers of glTF 2.0, section 3.6 and 4.4.
constexpr int arrayBuffer = 34962;
constexpr int elementArrayBuffer = 34963;
constexpr int componentU16 = 5123;
constexpr int componentU32 = 5125;
constexpr int componentFloat = 5126;
constexpr uint32_t glbMagic = 0x46546C67;
constexpr uint32_t jsonChunk = 0x4E4F534A;
constexpr uint32_t binaryChunk = 0x004E4942;

void append(std::vector<uint8_t>& to, uint32_t value) {
    to.resize(to.size() + 4);
    storeLe(to.data() + to.size() - 4, value);
}

void appendChunk(std::vector<uint8_t>& to, uint32_t type, std::span<const uint8_t> bytes, uint8_t padding) {
    const size_t padded = (bytes.size() + 3) / 4 * 4;
    append(to, static_cast<uint32_t>(padded));
    append(to, type);
    to.insert(to.end(), bytes.begin(), bytes.end());
    to.resize(to.size() + padded - bytes.size(), padding);
}

std::vector<float> flat(const std::vector<Vec3>& list) {
    std::vector<float> out;
    for (const Vec3& v : list) out.insert(out.end(), v.begin(), v.end());
    return out;
}

std::vector<float> flat(const std::vector<mesh::Uv>& list) {
    std::vector<float> out;
    for (const mesh::Uv& uv : list) out.insert(out.end(), {uv.u, uv.v});
    return out;
}

}  // namespace

GlbBuilder::GlbBuilder(const std::string& generator) {
    json_["asset"] = {{"version", "2.0"}, {"generator", generator}};
}

size_t GlbBuilder::add(const char* list, Json item) {
    json_[list].push_back(std::move(item));
    return json_[list].size() - 1;
}

size_t GlbBuilder::addView(std::span<const uint8_t> bytes, int target) {
    binary_.resize((binary_.size() + 3) / 4 * 4);
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    return add("bufferViews", std::move(view));
}

size_t GlbBuilder::addFloats(std::span<const float> values, size_t components, const char* type,
                             bool bounds) {
    std::vector<uint8_t> bytes(values.size() * 4);
    for (size_t i = 0; i < values.size(); ++i) storeLe(&bytes[4 * i], std::bit_cast<uint32_t>(values[i]));
    Json accessor = {{"bufferView", addView(bytes, arrayBuffer)},
                     {"componentType", componentFloat},
                     {"count", values.size() / components},
                     {"type", type}};
    for (size_t c = 0; bounds && c < components; ++c) {
        float lo = values[c];
        float hi = values[c];
        for (size_t i = c; i < values.size(); i += components) {
            lo = std::min(lo, values[i]);
            hi = std::max(hi, values[i]);
        }
        accessor["min"].push_back(lo);
        accessor["max"].push_back(hi);
    }
    return add("accessors", std::move(accessor));
}

size_t GlbBuilder::addIndices(const std::vector<uint32_t>& indices, size_t vertices) {
    const bool narrow = vertices < 65535;
    std::vector<uint8_t> bytes(indices.size() * (narrow ? 2 : 4));
    for (size_t i = 0; i < indices.size(); ++i) {
        if (narrow) {
            storeLe(&bytes[2 * i], static_cast<uint16_t>(indices[i]));
        } else {
            storeLe(&bytes[4 * i], indices[i]);
        }
    }
    return add("accessors", {{"bufferView", addView(bytes, elementArrayBuffer)},
                             {"componentType", narrow ? componentU16 : componentU32},
                             {"count", indices.size()},
                             {"type", "SCALAR"}});
}

Json GlbBuilder::primitive(const Geometry& g, size_t material) {
    Json attributes;
    attributes["POSITION"] = addFloats(flat(g.positions), 3, "VEC3", true);
    if (!g.normals.empty()) attributes["NORMAL"] = addFloats(flat(g.normals), 3, "VEC3", false);
    if (!g.uvs.empty()) attributes["TEXCOORD_0"] = addFloats(flat(g.uvs), 2, "VEC2", false);
    if (!g.colours.empty()) attributes["COLOR_0"] = addFloats(flat(g.colours), 3, "VEC3", false);
    return {{"attributes", attributes},
            {"indices", addIndices(g.indices, g.positions.size())},
            {"material", material}};
}

Result<size_t> GlbBuilder::addImage(const std::string& name, const scene::ColourImage& image) {
    const auto png = io::encodePng(image);
    if (!png) return png.error();
    return add("images", {{"name", name}, {"mimeType", "image/png"}, {"bufferView", addView(*png, 0)}});
}

Result<std::vector<uint8_t>> GlbBuilder::finish() {
    json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    const std::string text = json_.dump();
    std::vector<uint8_t> chunks;
    appendChunk(chunks, jsonChunk, {reinterpret_cast<const uint8_t*>(text.data()), text.size()}, ' ');
    appendChunk(chunks, binaryChunk, binary_, 0);
    if (chunks.size() > UINT32_MAX - 12) return Error{ErrorKind::limit, "a GLB file cannot hold 4 GiB"};
    std::vector<uint8_t> file;
    append(file, glbMagic);
    append(file, 2);
    append(file, static_cast<uint32_t>(12 + chunks.size()));
    file.insert(file.end(), chunks.begin(), chunks.end());
    return file;
}

}  // namespace filigree::jobs
