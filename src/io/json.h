// JSON from outside: bounded parsing, and members read so that every error names its JSON path.
#pragma once

#include "filigree/core/result.h"

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace filigree::io {

using Json =
    nlohmann::ordered_json;  // keeps the order of keys, so that a file written again reads like its source

// Arrays and objects inside each other.
inline constexpr size_t maxJsonDepth = 128;
// Of one object. Look-up in document order is linear, so more would let a small file take minutes.
inline constexpr size_t maxJsonMembers = 10'000;
// The largest integer that every JSON reader keeps exactly.
inline constexpr uint64_t maxJsonInteger = uint64_t{1} << 53;

Result<Json> parseJson(std::string_view text);

// A value for an error message: numbers and short strings as they stand, the type of anything else.
std::string describe(const Json& value);

// An empty list or object to read from where a document has none.
const Json& emptyArray();
const Json& emptyObject();

// Reads the members of one object. The first thing that is wrong sticks and shows in status(); what is read
// after that are the fallbacks, so a caller may read everything and ask once.
class ObjectReader {
  public:
    ObjectReader(const Json& object, std::string path);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] Status status() const { return error_ ? Status(*error_) : Status(); }
    [[nodiscard]] bool has(std::string_view key) const { return object_->contains(key); }

    // Integers in [least, most]. A required one reads as `least` when wrong.
    uint64_t integer(const char* key, uint64_t least, uint64_t most = maxJsonInteger);
    std::optional<uint64_t> optionalInteger(const char* key, uint64_t least, uint64_t most = maxJsonInteger);

    // The position of an item in a list of `size` items.
    uint64_t index(const char* key, size_t size);
    std::optional<uint64_t> optionalIndex(const char* key, size_t size);

    // Finite numbers in [least, most].
    double number(const char* key, double fallback, double least = std::numeric_limits<double>::lowest(),
                  double most = std::numeric_limits<double>::max());
    bool flag(const char* key, bool fallback);
    std::string text(const char* key, std::string_view fallback);

    // Exactly N finite numbers.
    template <size_t N>
    std::array<double, N> numbers(const char* key, std::array<double, N> fallback) {
        readNumbers(key, fallback.data(), N);
        return fallback;
    }

    // A member that must be an object or an array where it stands; an empty one where it is absent.
    const Json& object(const char* key);
    const Json& array(const char* key);

    // The path of a member, for readers of its own.
    [[nodiscard]] std::string pathOf(std::string_view key) const { return path_ + "/" + std::string(key); }

    void fail(std::string_view key, const Json& found, std::string_view expected);
    void missing(std::string_view key, std::string_view expected);

  private:
    [[nodiscard]] const Json* find(const char* key) const;
    void readNumbers(const char* key, double* values, size_t count);

    const Json* object_;
    std::string path_;
    std::optional<Error> error_;
};

}  // namespace filigree::io
