// Numbers within the value of an option.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace filigree::app {

// `text` as a number; anything else is wrong usage of `option`, whose value is `all`.
template <class Number>
Number parsedNumber(const std::string& text, const std::string& option, const std::string& all) {
    Number value{};
    if (!CLI::detail::lexical_cast(text, value)) throw CLI::ConversionError(all, option);
    return value;
}

}  // namespace filigree::app
