// A name for bytes that nobody confuses.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace filigree::jobs {

// SHA-256 (FIPS 180-4) in 64 hexadecimal digits.
std::string sha256(std::span<const uint8_t> bytes);

}  // namespace filigree::jobs
