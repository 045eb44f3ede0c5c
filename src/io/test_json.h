// The parameters of a bake as JSON: extras.filigree of a micromap, and "test" in the manifest of API blobs.
#pragma once

#include "filigree/image/alpha_image.h"

#include "io/json.h"

namespace filigree::io {

inline constexpr unsigned testVersion = 1;

Json testToJson(const image::AlphaTest& test);

// Fails on a version that is not known and on values out of range.
Result<image::AlphaTest> testFromJson(const Json& json, const std::string& path);

}  // namespace filigree::io
