// The parts of checkRules.
#pragma once

#include "filigree/io/breach.h"

#include "io/document.h"

#include <optional>
#include <string>
#include <vector>

namespace filigree::io {

// What the rules need to know of one micromap array. Nothing where it could not be read.
struct MicromapFacts {
    std::optional<size_t> records;
};

// Collects breaches.
class RuleCheck {
  public:
    explicit RuleCheck(const GltfDocument::Data& data) : data_(data) {}

    [[nodiscard]] const GltfDocument::Data& data() const { return data_; }
    void breach(std::string path, const char* rule, std::string message) {
        breaches_.push_back({std::move(path), rule, std::move(message)});
    }
    // Reports a failed read, whose message starts with its own path.
    void breach(const char* rule, const std::string& path, const Error& error);
    std::vector<Breach> take() && { return std::move(breaches_); }

  private:
    const GltfDocument::Data& data_;
    std::vector<Breach> breaches_;
};

// glTF's own rules for buffers, views and accessors.
void checkBuffers(RuleCheck& check);

// The root extension object; gives facts of each of its micromaps.
std::vector<MicromapFacts> checkMicromaps(RuleCheck& check, const char* extension);

// The extension object of every primitive that has one.
void checkPrimitives(RuleCheck& check, const char* extension, const std::vector<MicromapFacts>& micromaps);

// Whether an index stands for a micromap or a special one.
std::optional<size_t> triangleCountOf(const GltfDocument::Data& data, const Json& primitive);

}  // namespace filigree::io
