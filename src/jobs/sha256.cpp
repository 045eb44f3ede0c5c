#include "jobs/sha256.h"

#include <array>

#include <sha2.h>
#include <sys/types.h>

namespace filigree::jobs {

std::string sha256(std::span<const uint8_t> bytes) {
    SHA2_CTX context;
    SHA256Init(&context);
    SHA256Update(&context, bytes.data(), bytes.size());
    std::array<char, SHA256_DIGEST_STRING_LENGTH> text{};
    SHA256End(&context, text.data());
    return text.data();
}

}  // namespace filigree::jobs
