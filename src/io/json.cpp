#include "io/json.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace filigree::io {
namespace {

// Bounds depth and object sizes before the parser builds anything.
Status checkShape(std::string_view text) {
    std::vector<size_t> members{0};
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\') ++i;
            if (c == '"') inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            members.push_back(0);
            if (members.size() > maxJsonDepth + 1) {
                return Error{ErrorKind::limit,
                             fmt::format("JSON at byte {}: nested deeper than {} levels", i, maxJsonDepth)};
            }
        } else if (c == '}' || c == ']') {
            if (members.size() > 1) members.pop_back();
        } else if (c == ':' && ++members.back() > maxJsonMembers) {
            return Error{ErrorKind::limit, fmt::format("JSON at byte {}: an object of more than {} members",
                                                       i, maxJsonMembers)};
        }
    }
    return {};
}

// The integer that a JSON number holds; 5.0 counts as 5.
std::optional<uint64_t> integerOf(const Json& value) {
    if (value.is_number_unsigned()) return value.get<uint64_t>();
    if (!value.is_number_float()) return std::nullopt;
    const double number = value.get<double>();
    if (!(number >= 0 && number <= static_cast<double>(maxJsonInteger)) || number != std::floor(number)) {
        return std::nullopt;
    }
    return static_cast<uint64_t>(number);
}

}  // namespace

Result<Json> parseJson(std::string_view text) {
    if (const Status shape = checkShape(text); !shape) return shape.error();
    try {
        return Json::parse(text.begin(), text.end());
    } catch (const std::exception& e) {
        std::string_view what = e.what();
        if (const size_t end = what.find("] "); end != std::string_view::npos) what.remove_prefix(end + 2);
        return Error{ErrorKind::format, fmt::format("JSON: {}", what)};
    }
}

std::string describe(const Json& value) {
    if (value.is_structured()) return value.is_array() ? "an array" : "an object";
    std::string text = value.dump(-1, ' ', true);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return text;
}

const Json& emptyArray() {
    static const Json empty = Json::array();
    return empty;
}

const Json& emptyObject() {
    static const Json empty = Json::object();
    return empty;
}

ObjectReader::ObjectReader(const Json& object, std::string path)
    : object_(object.is_object() ? &object : &emptyObject()), path_(std::move(path)) {
    if (!object.is_object()) {
        error_ = Error{ErrorKind::format,
                       fmt::format("{}: found {}, expected an object", path_, describe(object))};
    }
}

const Json* ObjectReader::find(const char* key) const {
    const auto it = object_->find(key);
    return it == object_->end() ? nullptr : &*it;
}

void ObjectReader::fail(std::string_view key, const Json& found, std::string_view expected) {
    if (error_) return;
    error_ = Error{ErrorKind::format,
                   fmt::format("{}: found {}, expected {}", pathOf(key), describe(found), expected)};
}

void ObjectReader::missing(std::string_view key, std::string_view expected) {
    if (error_) return;
    error_ = Error{ErrorKind::format, fmt::format("{}: missing, expected {}", pathOf(key), expected)};
}

uint64_t ObjectReader::integer(const char* key, uint64_t least, uint64_t most) {
    const std::optional<uint64_t> value = optionalInteger(key, least, most);
    if (!value) missing(key, "an integer");
    return value.value_or(least);
}

std::optional<uint64_t> ObjectReader::optionalInteger(const char* key, uint64_t least, uint64_t most) {
    const Json* member = find(key);
    if (member == nullptr) return std::nullopt;
    const std::optional<uint64_t> value = integerOf(*member);
    if (value && *value >= least && *value <= most) return value;
    fail(key, *member, fmt::format("an integer from {} to {}", least, most));
    return least;
}

uint64_t ObjectReader::index(const char* key, size_t size) {
    const std::optional<uint64_t> value = optionalIndex(key, size);
    if (!value) missing(key, "an index");
    return value.value_or(0);
}

std::optional<uint64_t> ObjectReader::optionalIndex(const char* key, size_t size) {
    const Json* member = find(key);
    if (member == nullptr) return std::nullopt;
    const std::optional<uint64_t> value = integerOf(*member);
    if (value && *value < size) return value;
    fail(key, *member, fmt::format("an index below {}", size));
    return 0;
}

double ObjectReader::number(const char* key, double fallback, double least, double most) {
    const Json* member = find(key);
    if (member == nullptr) return fallback;
    const double value = member->is_number() ? member->get<double>() : std::nan("");
    if (value >= least && value <= most) return value;
    const bool bounded = most < std::numeric_limits<double>::max();
    fail(key, *member, bounded ? fmt::format("a number from {} to {}", least, most) : "a number in range");
    return fallback;
}

bool ObjectReader::flag(const char* key, bool fallback) {
    const Json* member = find(key);
    if (member == nullptr) return fallback;
    if (member->is_boolean()) return member->get<bool>();
    fail(key, *member, "true or false");
    return fallback;
}

std::string ObjectReader::text(const char* key, std::string_view fallback) {
    const Json* member = find(key);
    if (member == nullptr) return std::string(fallback);
    if (member->is_string()) return member->get<std::string>();
    fail(key, *member, "a string");
    return std::string(fallback);
}

const Json& ObjectReader::object(const char* key) {
    const Json* member = find(key);
    if (member == nullptr) return emptyObject();
    if (member->is_object()) return *member;
    fail(key, *member, "an object");
    return emptyObject();
}

const Json& ObjectReader::array(const char* key) {
    const Json* member = find(key);
    if (member == nullptr) return emptyArray();
    if (member->is_array()) return *member;
    fail(key, *member, "an array");
    return emptyArray();
}

void ObjectReader::readNumbers(const char* key, double* values, size_t count) {
    const Json* member = find(key);
    if (member == nullptr) return;
    bool good = member->is_array() && member->size() == count;
    for (size_t i = 0; good && i < count; ++i) good = (*member)[i].is_number();
    if (!good) return fail(key, *member, fmt::format("an array of {} numbers", count));
    for (size_t i = 0; i < count; ++i) values[i] = (*member)[i].get<double>();
}

}  // namespace filigree::io
