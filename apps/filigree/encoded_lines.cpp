#include "encoded_lines.h"

#include "filigree/report/number.h"

#include <fmt/format.h>

namespace filigree::app {

std::string bytesText(uint64_t bytes) {
    return report::formatBytes(static_cast<double>(bytes));
}

std::vector<std::pair<std::string, std::string>> encodedLines(const jobs::EncodedSize& size) {
    const std::string level = size.level ? std::to_string(*size.level) : "auto";
    return {{"encoding", fmt::format("{}, level {}, {} states", size.encoding, level, size.states)},
            {"maps", report::formatCount(size.maps)},
            {"bytes", fmt::format("payload {}, descriptors {}", bytesText(size.payloadBytes),
                                  bytesText(size.descriptorBytes))}};
}

}  // namespace filigree::app
