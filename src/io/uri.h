// URIs of glTF buffers and images: data URIs and relative paths, nothing else.
#pragma once

#include "filigree/core/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filigree::io {

bool isDataUri(std::string_view uri);

// The bytes of a base64 data URI (RFC 2397, RFC 4648).
Result<std::vector<uint8_t>> decodeDataUri(std::string_view uri);

// "data:MIMETYPE;base64,..."
std::string makeDataUri(std::string_view mimeType, std::span<const uint8_t> bytes);

// The relative path that a percent-encoded URI names (RFC 3986). ErrorKind::unsupported for a scheme such as
// http:, ErrorKind::format for absolute paths and broken escapes.
Result<std::filesystem::path> pathOfUri(std::string_view uri);

// The other way: a relative path as a percent-encoded URI.
std::string uriOfPath(const std::filesystem::path& path);

}  // namespace filigree::io
