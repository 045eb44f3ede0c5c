#include "io/glb.h"

#include "filigree/core/bytes.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree::io {
namespace {

constexpr uint32_t magic = 0x46546C67;      // "glTF"
constexpr uint32_t jsonChunk = 0x4E4F534A;  // "JSON"
constexpr uint32_t binChunk = 0x004E4942;   // "BIN\0"
constexpr size_t headerBytes = 12;
constexpr size_t chunkHeaderBytes = 8;

Error glbError(size_t offset, std::string what) {
    return {ErrorKind::format, fmt::format("GLB at byte {}: {}", offset, what)};
}

Status checkHeader(std::span<const uint8_t> bytes) {
    if (bytes.size() < headerBytes) {
        return glbError(0, fmt::format("{} bytes, expected a header of {}", bytes.size(), headerBytes));
    }
    const uint32_t version = loadLe<uint32_t>(bytes.data() + 4);
    if (version != 2) return glbError(4, fmt::format("version {}, expected 2", version));
    const uint32_t length = loadLe<uint32_t>(bytes.data() + 8);
    if (length != bytes.size()) {
        return glbError(8, fmt::format("length {}, expected the file's {} bytes", length, bytes.size()));
    }
    return {};
}

Result<GlbChunk> chunkAt(std::span<const uint8_t> bytes, size_t offset) {
    if (bytes.size() - offset < chunkHeaderBytes) return glbError(offset, "a chunk header is cut short");
    const uint32_t length = loadLe<uint32_t>(bytes.data() + offset);
    const size_t left = bytes.size() - offset - chunkHeaderBytes;
    if (length > left) {
        return glbError(offset, fmt::format("a chunk of {} bytes, expected at most {}", length, left));
    }
    if (length % 4 != 0) {
        return glbError(offset, fmt::format("a chunk of {} bytes, expected a multiple of 4", length));
    }
    return GlbChunk{loadLe<uint32_t>(bytes.data() + offset + 4),
                    bytes.subspan(offset + chunkHeaderBytes, length)};
}

constexpr size_t padded(size_t size) {
    return (size + 3) / 4 * 4;
}

// Appends one chunk of `pieces`, filled up to a multiple of 4 with `padding`.
void appendChunk(std::vector<uint8_t>& file, uint32_t type, std::span<const std::span<const uint8_t>> pieces,
                 uint8_t padding) {
    const size_t header = file.size();
    file.resize(header + chunkHeaderBytes);
    for (const std::span<const uint8_t> piece : pieces) file.insert(file.end(), piece.begin(), piece.end());
    file.resize(padded(file.size()), padding);
    storeLe(file.data() + header, static_cast<uint32_t>(file.size() - header - chunkHeaderBytes));
    storeLe(file.data() + header + 4, type);
}

size_t totalSize(std::span<const std::span<const uint8_t>> pieces) {
    size_t size = 0;
    for (const std::span<const uint8_t> piece : pieces) size += piece.size();
    return size;
}

}  // namespace

bool isGlb(std::span<const uint8_t> bytes) {
    return bytes.size() >= 4 && loadLe<uint32_t>(bytes.data()) == magic;
}

Result<Glb> parseGlb(std::span<const uint8_t> bytes) {
    if (const Status header = checkHeader(bytes); !header) return header.error();
    Glb glb;
    bool hasBinary = false;
    for (size_t offset = headerBytes; offset < bytes.size();) {
        const Result<GlbChunk> chunk = chunkAt(bytes, offset);
        if (!chunk) return chunk.error();
        const bool first = offset == headerBytes;
        if (first != (chunk->type == jsonChunk)) {
            return glbError(offset, "the first chunk and no other must be JSON");
        }
        if (first) {
            glb.json = {reinterpret_cast<const char*>(chunk->bytes.data()), chunk->bytes.size()};
        } else if (chunk->type == binChunk) {
            if (hasBinary) return glbError(offset, "a second BIN chunk");
            hasBinary = true;
            glb.binary = chunk->bytes;
        } else {
            glb.others.push_back(*chunk);
        }
        offset += chunkHeaderBytes + chunk->bytes.size();
    }
    if (glb.json.empty()) return glbError(headerBytes, "no JSON chunk");
    return glb;
}

Result<std::vector<uint8_t>> makeGlb(std::string_view json, std::span<const std::span<const uint8_t>> binary,
                                     std::span<const GlbChunk> others) {
    const std::span<const uint8_t> text(reinterpret_cast<const uint8_t*>(json.data()), json.size());
    size_t size = headerBytes + chunkHeaderBytes + padded(text.size());
    if (!binary.empty()) size += chunkHeaderBytes + padded(totalSize(binary));
    for (const GlbChunk& other : others) size += chunkHeaderBytes + padded(other.bytes.size());
    if (size > UINT32_MAX) {
        return Error{ErrorKind::limit,
                     fmt::format("GLB of {} bytes: the format ends at {}; choose a lower --level or --budget",
                                 size, UINT32_MAX)};
    }
    std::vector<uint8_t> file(headerBytes);
    file.reserve(size);
    storeLe(file.data(), magic);
    storeLe(file.data() + 4, uint32_t{2});
    storeLe(file.data() + 8, static_cast<uint32_t>(size));
    appendChunk(file, jsonChunk, std::span(&text, 1), ' ');
    if (!binary.empty()) appendChunk(file, binChunk, binary, 0);
    for (const GlbChunk& other : others) appendChunk(file, other.type, std::span(&other.bytes, 1), 0);
    return file;
}

}  // namespace filigree::io
