#include "io/write_buffers.h"

#include "filigree/io/image_file.h"

#include "io/read_parts.h"
#include "io/uri.h"

#include <array>

namespace filigree::io {
namespace {

constexpr std::string_view bufferMimeType = "application/octet-stream";

// Where the bytes of an old buffer are in the new file.
struct Place {
    size_t buffer = 0;
    size_t offset = 0;
};

// True when nothing is lost by making a buffer part of another.
bool isPlain(const Json& buffer) {
    for (const auto& [key, value] : buffer.items()) {
        if (key != "uri" && key != "byteLength") return false;
    }
    return true;
}

bool isRelative(const Json& item) {
    const Json* uri = memberOf(item, "uri");
    return uri != nullptr && uri->is_string() && !isDataUri(uri->get_ref<const std::string&>());
}

// Makes the buffers of a document one as far as they are plain; the first keeps its other members.
class BufferMerge {
  public:
    BufferMerge(const GltfDocument::Data& data, Rewrite& rewrite) : data_(data), rewrite_(rewrite) {}

    Status run() {
        const Json& old = data_.list("buffers");
        const bool firstHasBytes = !old.empty() && !data_.buffers[0].missing;
        buffers_.push_back(firstHasBytes ? old[0] : Json::object());
        buffers_[0].erase("uri");
        for (size_t i = 0; i < old.size(); ++i) {
            const bool merged = !data_.buffers[i].missing && (i == 0 || isPlain(old[i]));
            if (merged) {
                places_.push_back({0, rewrite_.pieces.add(data_.buffers[i].bytes)});
            } else if (const Status kept = keep(old[i], data_.buffers[i]); !kept) {
                return kept;
            }
        }
        rewrite_.json["buffers"] = std::move(buffers_);
        moveViews();
        return {};
    }

  private:
    Status keep(const Json& old, const Buffer& buffer) {
        if (buffer.missing && isRelative(old)) return *buffer.missing;
        places_.push_back({buffers_.size(), 0});
        buffers_.push_back(old);
        if (isRelative(old)) buffers_.back()["uri"] = makeDataUri(bufferMimeType, buffer.bytes);
        return {};
    }

    // Points buffer views, and extensions of them that name a buffer themselves, to the new places.
    void moveViews() {
        for (Json& view : arrayIn(rewrite_.json, "bufferViews")) {
            moveOne(view);
            if (memberOf(view, "extensions") == nullptr || !view["extensions"].is_object()) continue;
            for (Json& extension : view["extensions"]) moveOne(extension);
        }
    }

    void moveOne(Json& owner) {
        const Json* buffer = memberOf(owner, "buffer");
        if (buffer == nullptr || !buffer->is_number_unsigned() || buffer->get<size_t>() >= places_.size())
            return;
        const Place place = places_[buffer->get<size_t>()];
        owner["buffer"] = place.buffer;
        if (place.offset == 0) return;
        const Json* offset = memberOf(owner, "byteOffset");
        const size_t before = offset != nullptr && offset->is_number_unsigned() ? offset->get<size_t>() : 0;
        owner["byteOffset"] = before + place.offset;
    }

    const GltfDocument::Data& data_;
    Rewrite& rewrite_;
    Json buffers_ = Json::array();
    std::vector<Place> places_;
};

Status embedImages(const GltfDocument::Data& data, Rewrite& rewrite) {
    Json& images = arrayIn(rewrite.json, "images");
    for (size_t i = 0; i < images.size(); ++i) {
        if (!isRelative(images[i])) continue;
        std::vector<uint8_t> bytes;
        if (const auto found = imageBytes(data, i, bytes); !found) return found.error();
        const std::string_view type = mimeType(imageKind(bytes));
        images[i].erase("uri");
        if (!images[i].contains("mimeType") && !type.empty()) images[i]["mimeType"] = type;
        images[i]["bufferView"] = rewrite.addView(std::move(bytes), "image");
    }
    return {};
}

Status rebase(Json& items, const std::filesystem::path& from, const std::filesystem::path& to) {
    for (Json& item : items) {
        if (!isRelative(item)) continue;
        const Result<std::filesystem::path> path = pathOfUri(item["uri"].get_ref<const std::string&>());
        if (!path) continue;  // a URI that is not ours to read is not ours to change
        item["uri"] = uriOfPath((from / *path).lexically_normal().lexically_relative(to));
    }
    return {};
}

std::filesystem::path absoluteFolder(const std::filesystem::path& folder) {
    std::error_code ignored;
    return std::filesystem::absolute(folder.empty() ? "." : folder, ignored).lexically_normal();
}

// Lists that editing made and left empty; glTF forbids empty ones.
void dropEmptyLists(Json& json, const Json& original) {
    for (const char* key : {"bufferViews", "images", "buffers"}) {
        if (json.contains(key) && json[key].empty() && !original.contains(key)) json.erase(key);
    }
}

// Takes back the buffer for new bytes when none came.
void dropLastBuffer(Json& json) {
    Json& buffers = json["buffers"];
    buffers.erase(buffers.size() - 1);
    if (buffers.empty()) json.erase("buffers");
}

}  // namespace

size_t BufferPieces::add(std::span<const uint8_t> bytes) {
    static constexpr std::array<uint8_t, 3> zeros{};
    if (size_ % 4 != 0) {
        pieces_.push_back(std::span(zeros).first(4 - size_ % 4));
        size_ += pieces_.back().size();
    }
    const size_t offset = size_;
    pieces_.push_back(bytes);
    size_ += bytes.size();
    return offset;
}

size_t BufferPieces::add(std::vector<uint8_t>&& bytes) {
    owned_.push_back(std::move(bytes));
    return add(std::span<const uint8_t>(owned_.back()));
}

size_t Rewrite::append(const char* list, Json item) {
    Json& items = arrayIn(json, list);
    items.push_back(std::move(item));
    return items.size() - 1;
}

size_t Rewrite::addView(std::vector<uint8_t>&& bytes, const char* name) {
    Json view = Json::object();
    view["buffer"] = buffer;
    const size_t size = bytes.size();
    view["byteOffset"] = pieces.add(std::move(bytes));
    view["byteLength"] = size;
    view["name"] = name;
    return append("bufferViews", std::move(view));
}

Json& objectIn(Json& owner, const char* key) {
    Json& member = owner[key];
    if (!member.is_object()) member = Json::object();
    return member;
}

Json& arrayIn(Json& owner, const char* key) {
    Json& member = owner[key];
    if (!member.is_array()) member = Json::array();
    return member;
}

Result<Rewrite> rewriteForGlb(const GltfDocument::Data& data) {
    Rewrite rewrite;
    rewrite.json = data.json;
    if (const Status status = BufferMerge(data, rewrite).run(); !status) return status.error();
    if (const Status status = embedImages(data, rewrite); !status) return status.error();
    dropEmptyLists(rewrite.json, data.json);
    return rewrite;
}

Result<Rewrite> rewriteForGltf(const GltfDocument::Data& data, const std::filesystem::path& folder) {
    Rewrite rewrite;
    rewrite.json = data.json;
    const std::filesystem::path from = absoluteFolder(data.folder);
    const std::filesystem::path to = absoluteFolder(folder);
    Json& buffers = arrayIn(rewrite.json, "buffers");
    if (data.binary && !buffers.empty() && !buffers[0].contains("uri")) {
        buffers[0]["uri"] = makeDataUri(bufferMimeType, data.buffers[0].bytes);
    }
    if (from != to) {
        if (const Status status = rebase(buffers, from, to); !status) return status.error();
        if (const Status status = rebase(arrayIn(rewrite.json, "images"), from, to); !status)
            return status.error();
    }
    rewrite.buffer = buffers.size();
    buffers.push_back(Json::object());
    dropEmptyLists(rewrite.json, data.json);
    return rewrite;
}

Result<std::vector<uint8_t>> finishGlb(Rewrite& rewrite, const GltfDocument::Data& data) {
    if (rewrite.pieces.size() > 0) {
        rewrite.json["buffers"][rewrite.buffer]["byteLength"] = rewrite.pieces.size();
    } else {
        dropLastBuffer(rewrite.json);
    }
    const std::string text = rewrite.json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return makeGlb(text, rewrite.pieces.pieces(), data.others);
}

Result<std::vector<uint8_t>> finishGltf(Rewrite& rewrite) {
    std::vector<uint8_t> bytes;
    bytes.reserve(rewrite.pieces.size());
    for (const std::span<const uint8_t> piece : rewrite.pieces.pieces()) {
        bytes.insert(bytes.end(), piece.begin(), piece.end());
    }
    if (bytes.empty()) {
        dropLastBuffer(rewrite.json);
    } else {
        Json& buffer = rewrite.json["buffers"][rewrite.buffer];
        buffer["byteLength"] = bytes.size();
        buffer["uri"] = makeDataUri(bufferMimeType, bytes);
    }
    const std::string text = rewrite.json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    return std::vector<uint8_t>(text.begin(), text.end());
}

}  // namespace filigree::io
