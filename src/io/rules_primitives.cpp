// Rules of the extension object of a primitive.
#include "io/accessor.h"
#include "io/micromap_bytes.h"
#include "io/rules.h"

#include <fmt/format.h>

namespace filigree::io {
namespace {

class PrimitiveCheck {
  public:
    PrimitiveCheck(RuleCheck& check, const Json& primitive, const Json& extension,
                   const std::string& primitivePath, std::string path,
                   const std::vector<MicromapFacts>& micromaps)
        : check_(check),
          primitive_(primitive),
          extension_(extension),
          primitivePath_(primitivePath),
          path_(std::move(path)),
          micromaps_(micromaps) {}

    void run() {
        checkMode();
        if (!extension_.is_object()) {
            return check_.breach(path_, "omm-primitive",
                                 "found " + describe(extension_) + ", expected an object");
        }
        triangles_ = triangleCountOf(check_.data(), primitive_);
        if (!triangles_) {
            check_.breach(primitivePath_, "omm-triangle-count", "its number of triangles cannot be read");
        }
        readMembers();
        if (accessor_) {
            checkAccessor();
        } else if (!extension_.contains("micromapIndices")) {
            checkImplicit();
        }
    }

  private:
    [[nodiscard]] std::string at(std::string_view key) const { return fmt::format("{}/{}", path_, key); }

    void checkMode() {
        ObjectReader reader(primitive_, primitivePath_);
        if (reader.optionalInteger("mode", 0, 6).value_or(4) == 4 && reader.status()) return;
        check_.breach(primitivePath_ + "/mode", "omm-primitive-mode", "expected 4 (triangles)");
    }

    // Each member with a reader of its own, so that one wrong member hides no other.
    void readMembers() {
        ObjectReader micromap(extension_, path_);
        const size_t index = micromap.index("micromap", micromaps_.size());
        if (const Status status = micromap.status(); !status) {
            check_.breach("omm-primitive-micromap", at("micromap"), status.error());
        } else {
            records_ = micromaps_[index].records;
        }
        ObjectReader base(extension_, path_);
        base_ = base.optionalInteger("micromapBaseTriangle", 0).value_or(0);
        if (const Status status = base.status(); !status) {
            check_.breach("omm-base-triangle", at("micromapBaseTriangle"), status.error());
        }
        ObjectReader indices(extension_, path_);
        accessor_ = indices.optionalIndex("micromapIndices", check_.data().list("accessors").size());
        if (const Status status = indices.status(); !status) {
            accessor_.reset();
            check_.breach("omm-index-accessor", at("micromapIndices"), status.error());
        }
    }

    // Without indices, triangle t has record t + base.
    void checkImplicit() {
        if (!triangles_ || !records_ || *triangles_ + base_ <= *records_) return;
        check_.breach(path_, "omm-implicit-indices",
                      fmt::format("no micromapIndices, {} triangles from base {} on, but {} records",
                                  *triangles_, base_, *records_));
    }

    void checkAccessor() {
        const Result<Elements> elements = findElements(check_.data(), *accessor_);
        if (!elements) return check_.breach("omm-index-accessor", at("micromapIndices"), elements.error());
        const Accessor& accessor = elements->accessor;
        if (accessor.normalized)
            tell("omm-index-normalized", "found normalized integers, expected plain ones");
        if (accessor.bufferView) checkStride(*accessor.bufferView);
        if (triangles_ && accessor.count != *triangles_) {
            tell("omm-index-count", fmt::format("{} indices, expected one for each of {} triangles",
                                                accessor.count, *triangles_));
        }
        if (checkType(accessor)) checkValues(*elements);
    }

    void tell(const char* rule, std::string message) {
        check_.breach(at("micromapIndices"), rule, std::move(message));
    }

    void checkStride(size_t view) {
        if (memberOf(check_.data().list("bufferViews")[view], "byteStride") == nullptr) return;
        tell("omm-index-stride", "newest draft: its buffer view has a byteStride, expected none");
    }

    bool checkType(const Accessor& accessor) {
        const bool component =
            accessor.componentType != ComponentType::float32 && accessor.componentType != ComponentType::int8;
        if (accessor.type != "SCALAR" || !component) {
            tell("omm-index-type",
                 fmt::format(
                     "found {} of component type {}, expected SCALAR of 5121, 5122, 5123, 5124 or 5125",
                     accessor.type, static_cast<uint32_t>(accessor.componentType)));
        }
        return accessor.type == "SCALAR" && component;
    }

    void checkValues(const Elements& elements) {
        const ComponentType type = elements.accessor.componentType;
        const size_t bytes = componentBytes(type);
        std::optional<std::pair<uint64_t, int64_t>> first;
        forEachElement(elements, [&](uint64_t t, const Element& e) {
            const int64_t value =
                isSigned(type) ? static_cast<int64_t>(e[0]) : signedIndex(static_cast<uint32_t>(e[0]), bytes);
            if (!first && !isInRange(value)) first = {t, value};
        });
        if (!first) return;
        tell("omm-index-value",
             fmt::format("triangle {}: {} with base {}, expected -4 to -1 or below {} records", first->first,
                         first->second, base_, records_.value_or(0)));
    }

    [[nodiscard]] bool isInRange(int64_t value) const {
        if (value < 0) return value >= -4;
        return !records_ || static_cast<uint64_t>(value) + base_ < *records_;
    }

    RuleCheck& check_;
    const Json& primitive_;
    const Json& extension_;
    const std::string& primitivePath_;
    std::string path_;
    const std::vector<MicromapFacts>& micromaps_;
    std::optional<size_t> triangles_;
    std::optional<size_t> records_;
    std::optional<uint64_t> accessor_;
    uint64_t base_ = 0;
};

}  // namespace

std::optional<size_t> triangleCountOf(const GltfDocument::Data& data, const Json& primitive) {
    ObjectReader reader(primitive, "");
    ObjectReader attributes(reader.object("attributes"), "");
    const size_t accessors = data.list("accessors").size();
    std::optional<uint64_t> index = reader.optionalIndex("indices", accessors);
    if (!index) index = attributes.optionalIndex("POSITION", accessors);
    if (!index || !reader.status() || !attributes.status()) return std::nullopt;
    const Result<Accessor> accessor = readAccessor(data, *index);
    if (!accessor) return std::nullopt;
    return accessor->count / 3;
}

void checkPrimitives(RuleCheck& check, const char* extension, const std::vector<MicromapFacts>& micromaps) {
    const Json& meshes = check.data().list("meshes");
    for (size_t m = 0; m < meshes.size(); ++m) {
        const Json* primitives = memberOf(meshes[m], "primitives");
        if (primitives == nullptr || !primitives->is_array()) continue;
        for (size_t p = 0; p < primitives->size(); ++p) {
            const Json& primitive = (*primitives)[p];
            const Json* object = extensionOf(primitive, extension);
            if (object == nullptr) continue;
            const std::string path = fmt::format("/meshes/{}/primitives/{}", m, p);
            PrimitiveCheck(check, primitive, *object, path, fmt::format("{}/extensions/{}", path, extension),
                           micromaps)
                .run();
        }
    }
}

}  // namespace filigree::io
