#include "io/uri.h"

#include <array>
#include <cctype>

#include <fmt/format.h>

namespace filigree::io {
namespace {

constexpr std::string_view base64Digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<int8_t, 256> base64Values = [] {
    std::array<int8_t, 256> values{};
    values.fill(-1);
    for (size_t i = 0; i < base64Digits.size(); ++i) {
        values[static_cast<uint8_t>(base64Digits[i])] = static_cast<int8_t>(i);
    }
    return values;
}();

Error badUri(std::string_view uri, std::string_view what) {
    constexpr size_t most = 60;
    return {ErrorKind::format,
            fmt::format("URI \"{}{}\": {}", uri.substr(0, most), uri.size() > most ? "..." : "", what)};
}

Result<std::vector<uint8_t>> decodeBase64(std::string_view text) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    unsigned held = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        const int value = base64Values[static_cast<uint8_t>(text[i])];
        if (value < 0) {
            return Error{ErrorKind::format, fmt::format("base64 at character {}: not a base64 digit", i)};
        }
        bits = (bits << 6 | static_cast<uint32_t>(value)) & 0xFFFFFF;
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(static_cast<uint8_t>(bits >> held));
    }
    if (held == 6) return Error{ErrorKind::format, "base64: one digit too many at its end"};
    return bytes;
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// A scheme is letters, digits, "+-." up to a colon, before any slash.
bool hasScheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    return colon != std::string_view::npos && uri.find('/') > colon;
}

}  // namespace

bool isDataUri(std::string_view uri) {
    return uri.starts_with("data:");
}

Result<std::vector<uint8_t>> decodeDataUri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos) return badUri(uri, "a data URI without a comma");
    if (!uri.substr(0, comma).ends_with(";base64")) return badUri(uri, "expected a base64 data URI");
    return decodeBase64(uri.substr(comma + 1));
}

std::string makeDataUri(std::string_view mimeType, std::span<const uint8_t> bytes) {
    std::string uri = fmt::format("data:{};base64,", mimeType);
    uri.reserve(uri.size() + (bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t left = std::min<size_t>(3, bytes.size() - i);
        uint32_t bits = uint32_t{bytes[i]} << 16;
        if (left > 1) bits |= uint32_t{bytes[i + 1]} << 8;
        if (left > 2) bits |= bytes[i + 2];
        for (size_t k = 0; k < 4; ++k) {
            uri += k <= left ? base64Digits[bits >> (18 - 6 * k) & 63] : '=';
        }
    }
    return uri;
}

Result<std::filesystem::path> pathOfUri(std::string_view uri) {
    if (uri.empty()) return badUri(uri, "empty, expected a relative path");
    if (hasScheme(uri)) {
        return Error{ErrorKind::unsupported,
                     badUri(uri, "only data URIs and relative paths are read").message};
    }
    std::string path;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            path += uri[i];
            continue;
        }
        const int high = i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
        const int low = i + 2 < uri.size() ? hexDigit(uri[i + 2]) : -1;
        if (high < 0 || low < 0) return badUri(uri, "expected two hexadecimal digits after %");
        path += static_cast<char>(high * 16 + low);
        i += 2;
    }
    if (path.find('\0') != std::string::npos) return badUri(uri, "a path cannot hold a zero byte");
    if (path.front() == '/') return badUri(uri, "an absolute path, expected a relative one");
    return std::filesystem::path(path);
}

std::string uriOfPath(const std::filesystem::path& path) {
    std::string uri;
    for (const char c : path.generic_string()) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                           std::string_view("-._~/!$&'()*+,;=@").find(c) != std::string_view::npos;
        if (plain && static_cast<unsigned char>(c) < 128) {
            uri += c;
        } else {
            uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        }
    }
    return uri;
}

}  // namespace filigree::io
