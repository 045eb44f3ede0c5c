#include "filigree/core/mapped_file.h"

#include "core/descriptor.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

namespace filigree {

Result<MappedFile> MappedFile::open(const std::filesystem::path& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) return fileError(path, "cannot open");
    struct stat info {};
    if (::fstat(file.get(), &info) != 0) return fileError(path, "cannot read");
    if (!S_ISREG(info.st_mode))
        return Error{ErrorKind::file, path.string() + ": is no regular file, expected one"};
    const auto size = static_cast<size_t>(info.st_size);
    if (size == 0) return MappedFile();
    void* const at = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
    if (at == MAP_FAILED) return fileError(path, "cannot map");
    return MappedFile({static_cast<const uint8_t*>(at), size});
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
}

MappedFile::~MappedFile() {
    if (!bytes_.empty()) ::munmap(const_cast<uint8_t*>(bytes_.data()), bytes_.size());
}

}  // namespace filigree
