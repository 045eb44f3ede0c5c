// How every reader of micromaps or squares in a .fil begins.
#pragma once

#include "filigree/core/mapped_file.h"
#include "filigree/core/result.h"
#include "filigree/io/fil.h"

#include "io/fil_layout.h"
#include "io/fil_meta.h"
#include "io/fil_sections.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace filigree::io {

// Gives the files, whose friend it is, bytes to open: FilFile or FilSquareFile.
class FilLoading {
  public:
    template <class File>
    static Result<File> read(const std::filesystem::path& path, const FilReadOptions& options) {
        Result<MappedFile> mapped = MappedFile::open(path);
        if (!mapped) return mapped.error();
        File file;
        file.mapped_ = std::move(*mapped);
        if (const Status status = file.open(file.mapped_.bytes(), options); !status)
            return status.error().within(path.string());
        return file;
    }

    template <class File>
    static Result<File> view(std::span<const uint8_t> bytes, const std::string& name,
                             const FilReadOptions& options) {
        File file;
        if (const Status status = file.open(bytes, options); !status) return status.error().within(name);
        return file;
    }

    template <class File>
    static Result<File> parse(std::vector<uint8_t> bytes, const std::string& name,
                              const FilReadOptions& options) {
        File file;
        file.bytes_ = std::move(bytes);
        if (const Status status = file.open(file.bytes_, options); !status)
            return status.error().within(name);
        return file;
    }
};

inline Result<FilHead> headOf(FilSections& sections) {
    const auto meta = sections.take(FilKind::meta, 0, filMostMetaBytes);
    if (!meta) return meta.error();
    auto head = decodeMeta(*meta);
    if (!head) return head.error().within("section meta");
    return head;
}

}  // namespace filigree::io
