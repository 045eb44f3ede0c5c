#include "io/rules.h"

#include "filigree/io/gltf_rules.h"

#include "io/accessor.h"

#include <fmt/format.h>

namespace filigree::io {
namespace {

void checkView(RuleCheck& check, size_t index) {
    const Result<BufferView> view = readBufferView(check.data(), index);
    if (view || view.error().kind == ErrorKind::unsupported) return;
    check.breach("view-in-buffer", fmt::format("/bufferViews/{}", index), view.error());
}

// Offsets and strides must be multiples of the component size (glTF 2.0 section 3.6.2.4).
void checkAlignment(RuleCheck& check, const Accessor& accessor) {
    if (!accessor.bufferView) return;
    const Json& view = check.data().list("bufferViews")[*accessor.bufferView];
    ObjectReader reader(view, "");
    const uint64_t start = reader.optionalInteger("byteOffset", 0).value_or(0) + accessor.byteOffset;
    const uint64_t stride = reader.optionalInteger("byteStride", 4, 252).value_or(0);
    const size_t size = componentBytes(accessor.componentType);
    if (start % size == 0 && stride % size == 0) return;
    check.breach(accessor.path, "accessor-alignment",
                 fmt::format("starts at byte {} of its buffer with stride {}, expected multiples of {}",
                             start, stride, size));
}

void checkAccessor(RuleCheck& check, size_t index) {
    const Result<Accessor> accessor = readAccessor(check.data(), index);
    if (!accessor) {
        return check.breach("accessor", fmt::format("/accessors/{}", index), accessor.error());
    }
    checkAlignment(check, *accessor);
    const Result<Elements> elements = findElements(check.data(), index);
    if (elements || elements.error().kind != ErrorKind::format) return;
    if (accessor->bufferView && !readBufferView(check.data(), *accessor->bufferView))
        return;  // told of the view
    check.breach("accessor-in-view", accessor->path, elements.error());
}

bool primitivesCarry(const GltfDocument::Data& data, const char* extension) {
    for (const Json& mesh : data.list("meshes")) {
        const Json* primitives = memberOf(mesh, "primitives");
        if (primitives == nullptr || !primitives->is_array()) continue;
        for (const Json& primitive : *primitives) {
            if (extensionOf(primitive, extension) != nullptr) return true;
        }
    }
    return false;
}

void checkListing(RuleCheck& check, const char* extension) {
    const Json& json = check.data().json;
    const bool carried = extensionOf(json, extension) != nullptr || primitivesCarry(check.data(), extension);
    if (carried && !listsExtension(json, "extensionsUsed", extension)) {
        check.breach("/extensionsUsed", "omm-used", fmt::format("{} is used but not listed", extension));
    }
    if (listsExtension(json, "extensionsRequired", extension)) {
        check.breach("/extensionsRequired", "omm-not-required",
                     fmt::format("newest draft: {} should not be required", extension));
    }
}

}  // namespace

void RuleCheck::breach(const char* rule, const std::string& path, const Error& error) {
    // Messages of failed reads begin with their place, which may be deeper than `path`.
    const size_t colon = error.message.find(": ");
    const bool placed = error.message.starts_with("/") && colon != std::string::npos;
    breach(placed ? error.message.substr(0, colon) : path, rule,
           placed ? error.message.substr(colon + 2) : error.message);
}

void checkBuffers(RuleCheck& check) {
    const GltfDocument::Data& data = check.data();
    for (size_t i = 0; i < data.buffers.size(); ++i) {
        const std::optional<Error>& missing = data.buffers[i].missing;
        // Without a uri it is the fallback of a compressed buffer, which has no bytes of its own.
        if (missing && memberOf(data.list("buffers")[i], "uri") != nullptr) {
            check.breach("buffer", fmt::format("/buffers/{}", i), *missing);
        }
    }
    for (size_t i = 0; i < data.list("bufferViews").size(); ++i) checkView(check, i);
    for (size_t i = 0; i < data.list("accessors").size(); ++i) checkAccessor(check, i);
}

std::vector<Breach> checkRules(const GltfDocument& document) {
    RuleCheck check(document.data());
    checkBuffers(check);
    for (const char* extension : micromapExtensions) {
        checkListing(check, extension);
        checkPrimitives(check, extension, checkMicromaps(check, extension));
    }
    return std::move(check).take();
}

}  // namespace filigree::io
