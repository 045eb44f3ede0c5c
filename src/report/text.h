// Text made safe for the formats that carry it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace filigree::report {

// `text` with bytes that are not UTF-8, and control characters other than tab and line ends, as U+FFFD.
std::string validUtf8(std::string_view text);

// validUtf8 with the characters that HTML or XML give a meaning replaced.
std::string escapeHtml(std::string_view text);

std::string base64(std::span<const uint8_t> bytes);

// `path` as a relative URL: '/' stays, everything outside RFC 3986's unreserved set is percent-encoded.
std::string relativeUrl(std::string_view path);

}  // namespace filigree::report
