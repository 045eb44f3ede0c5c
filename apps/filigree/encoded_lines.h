// What an encoded set is and takes, as lines for people.
#pragma once

#include "filigree/jobs/encoded_size.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace filigree::app {

std::vector<std::pair<std::string, std::string>> encodedLines(const jobs::EncodedSize& size);

// "24.0 MiB".
std::string bytesText(uint64_t bytes);

}  // namespace filigree::app
