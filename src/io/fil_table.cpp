#include "io/fil_table.h"

#include "filigree/core/bytes.h"

#include <algorithm>

#include <xxhash.h>

namespace filigree::io {
namespace {

template <class... Args>
Error broken(fmt::format_string<Args...> text, Args&&... args) {
    return {ErrorKind::format, fmt::format(text, std::forward<Args>(args)...)};
}

Status checkHash(std::span<const uint8_t> bytes, uint64_t expected, const std::string& what) {
    const uint64_t found = XXH3_64bits(bytes.data(), bytes.size());
    if (found == expected) return {};
    return broken("{}: its bytes have the hash {:016x}, expected {:016x}: the file is damaged", what, found,
                  expected);
}

// The number of sections, once the header is right.
Result<size_t> readHeader(std::span<const uint8_t> file) {
    if (file.size() < filHeaderBytes || !std::equal(filMagic.begin(), filMagic.end(), file.begin()))
        return broken("the first bytes are not those of a .fil file");
    const auto version = loadLe<uint32_t>(file.data() + 8);
    if (version != filVersion) return broken("version {}, expected {}", version, filVersion);
    const auto count = loadLe<uint32_t>(file.data() + 12);
    if (count > filMaxSections) return broken("{} sections, expected at most {}", count, filMaxSections);
    const size_t hashed = filHeaderBytes + count * filEntryBytes;
    if (file.size() < hashed + filHashBytes)
        return broken("{} bytes, expected a table of {} sections", file.size(), count);
    const Status status =
        checkHash(file.first(hashed), loadLe<uint64_t>(file.data() + hashed), "the table of sections");
    if (!status) return status.error();
    if (const auto bytes = loadLe<uint64_t>(file.data() + 16); bytes != file.size())
        return broken("{} bytes, expected {}", file.size(), bytes);
    return size_t{count};
}

// The section of an entry. `end` is where the one before it ended, and then where this one ends.
Result<FilSection> readEntry(std::span<const uint8_t> file, const uint8_t* entry, uint64_t& end) {
    FilSection section;
    section.kind = loadLe<uint32_t>(entry);
    const std::string name = "section " + filKindName(section.kind);
    const auto flags = loadLe<uint32_t>(entry + 4);
    const auto offset = loadLe<uint64_t>(entry + 8);
    const auto bytes = loadLe<uint64_t>(entry + 16);
    section.plainBytes = loadLe<uint64_t>(entry + 24);
    section.zstd = (flags & filZstd) != 0;
    if ((flags & ~filZstd) != 0) return broken("{}: flags {:#x}, expected 0 or {}", name, flags, filZstd);
    if (offset != filAligned(end))
        return broken("{}: begins at {}, expected {}", name, offset, filAligned(end));
    if (offset > file.size() || bytes > file.size() - offset)
        return broken("{}: bytes {} to {} of {}", name, offset, offset + bytes, file.size());
    if (!section.zstd && bytes != section.plainBytes)
        return broken("{}: {} bytes, {} when plain, though it is not compressed", name, bytes,
                      section.plainBytes);
    const auto gap = file.subspan(end, offset - end);
    if (!std::ranges::all_of(gap, [](uint8_t byte) { return byte == 0; }))
        return broken("{}: bytes {} to {} before it are not zero", name, end, offset);
    section.stored = file.subspan(offset, bytes);
    if (const Status status = checkHash(section.stored, loadLe<uint64_t>(entry + 32), name); !status)
        return status.error();
    end = offset + bytes;
    return section;
}

}  // namespace

Result<std::vector<FilSection>> readTable(std::span<const uint8_t> file) {
    const Result<size_t> count = readHeader(file);
    if (!count) return count.error();
    uint64_t end = filHeaderBytes + *count * filEntryBytes + filHashBytes;
    std::vector<FilSection> sections;
    for (size_t k = 0; k < *count; ++k) {
        const Result<FilSection> section =
            readEntry(file, file.data() + filHeaderBytes + k * filEntryBytes, end);
        if (!section) return section.error();
        if (section->kind >= filOptionalKind) continue;
        if (section->kind < static_cast<uint32_t>(FilKind::meta) ||
            section->kind > static_cast<uint32_t>(filLastKind))
            return broken("section {}: not known to this version", filKindName(section->kind));
        if (std::ranges::any_of(sections, [&](const auto& s) { return s.kind == section->kind; }))
            return broken("section {}: stands twice", filKindName(section->kind));
        sections.push_back(*section);
    }
    if (end != file.size()) return broken("{} bytes after the last section", file.size() - end);
    return sections;
}

}  // namespace filigree::io
