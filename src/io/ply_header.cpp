#include "io/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

namespace filigree::io {
namespace {

constexpr size_t mostHeaderBytes = size_t{1} << 20;

constexpr std::array<std::pair<std::string_view, PlyType>, 16> plyTypeNames{{
    {"char", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"short", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"int", PlyType::int32},
    {"uint", PlyType::uint32},
    {"float", PlyType::float32},
    {"double", PlyType::float64},
    {"int8", PlyType::int8},
    {"uint8", PlyType::uint8},
    {"int16", PlyType::int16},
    {"uint16", PlyType::uint16},
    {"int32", PlyType::int32},
    {"uint32", PlyType::uint32},
    {"float32", PlyType::float32},
    {"float64", PlyType::float64},
}};

constexpr std::array<std::pair<std::string_view, PlyFormat>, 3> plyFormatNames{{
    {"ascii", PlyFormat::ascii},
    {"binary_little_endian", PlyFormat::littleEndian},
    {"binary_big_endian", PlyFormat::bigEndian},
}};

template <class Names>
auto named(const Names& names, std::string_view name) -> decltype(std::optional{names[0].second}) {
    for (const auto& [known, value] : names) {
        if (known == name) return value;
    }
    return std::nullopt;
}

// What the file holds in a message: short, and without what a terminal would act on.
std::string plyQuote(std::string_view text) {
    std::string quoted(text.substr(0, 40));
    std::ranges::replace_if(
        quoted, [](char c) { return c < ' ' || c > '~'; }, '?');
    return '"' + quoted + '"';
}

std::vector<std::string_view> wordsOf(std::string_view line) {
    constexpr std::string_view blanks = " \t\r";
    std::vector<std::string_view> words;
    for (size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;
         at = line.find_first_not_of(blanks, at)) {
        const size_t end = std::min(line.find_first_of(blanks, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = end;
    }
    return words;
}

class HeaderReading {
  public:
    explicit HeaderReading(std::string_view text) : text_(text) {}

    Result<PlyHeader> read() {
        if (!nextLine() || words_ != std::vector<std::string_view>{"ply"})
            return Error{ErrorKind::format, "not a PLY file: it does not begin with a line \"ply\""};
        while (nextLine()) {
            if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") continue;
            if (words_[0] == "end_header") return finish();
            const Status line = readLine();
            if (!line) return line.error().within(fmt::format("header line {}", line_));
        }
        return Error{ErrorKind::format, fmt::format("the header breaks off behind line {}, expected "
                                                    "end_header",
                                                    line_)};
    }

  private:
    bool nextLine() {
        const size_t end = text_.find('\n', header_.bytes);
        if (end == std::string_view::npos) return false;
        words_ = wordsOf(text_.substr(header_.bytes, end - header_.bytes));
        header_.bytes = end + 1;
        ++line_;
        return true;
    }

    Result<PlyHeader> finish() {
        if (!format_) return Error{ErrorKind::format, "the header has no line \"format\""};
        header_.format = *format_;
        return std::move(header_);
    }

    Status readLine() {
        if (words_[0] == "format") return readFormat();
        if (words_[0] == "element") return readElement();
        if (words_[0] == "property") return readProperty();
        return Error{ErrorKind::format,
                     fmt::format("{}, expected format, element, property, comment, obj_info or end_header",
                                 plyQuote(words_[0]))};
    }

    Status readFormat() {
        if (format_) return Error{ErrorKind::format, "a second format"};
        if (words_.size() == 3 && words_[2] == "1.0") format_ = named(plyFormatNames, words_[1]);
        if (!format_) {
            return Error{ErrorKind::format,
                         "expected format ascii, binary_little_endian or "
                         "binary_big_endian, and 1.0"};
        }
        return {};
    }

    Status readElement() {
        PlyElement element;
        if (words_.size() != 3) return Error{ErrorKind::format, "expected element, name and count"};
        const auto [end, error] =
            std::from_chars(words_[2].data(), words_[2].data() + words_[2].size(), element.count);
        if (error != std::errc{} || end != words_[2].data() + words_[2].size())
            return Error{ErrorKind::format, fmt::format("count {}, expected a number", plyQuote(words_[2]))};
        element.name = words_[1];
        if (std::ranges::find(header_.elements, element.name, &PlyElement::name) != header_.elements.end())
            return Error{ErrorKind::format, fmt::format("a second element {}", plyQuote(words_[1]))};
        header_.elements.push_back(std::move(element));
        return {};
    }

    Status readProperty() {
        if (header_.elements.empty()) return Error{ErrorKind::format, "a property before any element"};
        PlyProperty property;
        const bool isList = words_.size() == 5 && words_[1] == "list";
        if (!isList && words_.size() != 3)
            return Error{ErrorKind::format,
                         "expected property, type and name, or property list, two types "
                         "and name"};
        const auto type = named(plyTypeNames, words_[words_.size() - 2]);
        if (isList) property.countType = named(plyTypeNames, words_[2]);
        if (!type || (isList && !property.countType))
            return Error{ErrorKind::format, "a type that PLY does not know"};
        property.type = *type;
        property.name = words_.back();
        PlyElement& element = header_.elements.back();
        if (element.find(property.name))
            return Error{ErrorKind::format, fmt::format("a second property {}", plyQuote(words_.back()))};
        element.properties.push_back(std::move(property));
        return {};
    }

    std::string_view text_;
    std::vector<std::string_view> words_;  // of the line
    size_t line_ = 0;
    std::optional<PlyFormat> format_;
    PlyHeader header_;
};

}  // namespace

size_t sizeOf(PlyType type) {
    constexpr std::array<size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<size_t>(type)];
}

size_t PlyProperty::leastBytes(PlyFormat format) const {
    return format == PlyFormat::ascii ? 1 : sizeOf(countType.value_or(type));
}

size_t PlyElement::leastBytes(PlyFormat format) const {
    size_t bytes = 0;
    for (const PlyProperty& property : properties) bytes += property.leastBytes(format);
    return bytes;
}

std::optional<size_t> PlyElement::find(std::string_view property) const {
    const auto found = std::ranges::find(properties, property, &PlyProperty::name);
    if (found == properties.end()) return std::nullopt;
    return static_cast<size_t>(found - properties.begin());
}

Result<PlyHeader> readPlyHeader(std::span<const uint8_t> bytes) {
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    return HeaderReading({text, std::min(bytes.size(), mostHeaderBytes)}).read();
}

}  // namespace filigree::io
