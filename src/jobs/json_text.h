// Results as JSON text.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace filigree::jobs {

// Keeps the order in which members are written.
using Json = nlohmann::ordered_json;

// Two spaces a level; bytes of texts that are not UTF-8 become U+FFFD.
inline std::string dump(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace filigree::jobs
