#include "jobs/micromap_files.h"

#include "filigree/io/api_blob.h"

#include <system_error>

namespace filigree::jobs {

Status writeMicromapFiles(const io::GltfDocument& document, const io::MicromapOutput& output,
                          const std::filesystem::path& file, const std::filesystem::path& rawFolder) {
    if (!rawFolder.empty()) {
        const std::string source = std::filesystem::path(document.name()).filename().string();
        auto written = io::writeApiBlobs(rawFolder, output, source);
        if (!written) return written;
    }
    if (file.empty()) return {};
    auto written = io::writeWithMicromaps(document, output, file);
    if (!written && !rawFolder.empty()) {
        std::error_code ignored;
        std::filesystem::remove_all(rawFolder, ignored);
    }
    return written;
}

}  // namespace filigree::jobs
