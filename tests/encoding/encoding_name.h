// Names of tests that run once an encoding.
#pragma once

#include "filigree/encoding/encoded_set.h"

#include <string>
#include <tuple>

#include <gtest/gtest.h>

namespace filigree::tests {

// After the encoding that is the parameter, or the first part of it.
struct EncodingName {
    std::string operator()(const testing::TestParamInfo<encoding::Encoding>& info) const {
        std::string name(nameOf(info.param));
        std::erase(name, '-');
        return name;
    }
    std::string operator()(
        const testing::TestParamInfo<std::tuple<encoding::Encoding, micromap::Format>>& info) const {
        const auto [encoding, format] = info.param;
        return (*this)({encoding, info.index}) +
               (format == micromap::Format::twoState ? "TwoState" : "FourState");
    }
};

}  // namespace filigree::tests
