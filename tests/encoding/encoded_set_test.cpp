#include "filigree/encoding/encoded_set.h"

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

TEST(EncodedSet, NamesLeadBackToTheirEncodings) {
    for (unsigned k = 0; k < encodingCount; ++k) {
        const auto encoding = static_cast<Encoding>(k);
        EXPECT_EQ(encodingNamed(nameOf(encoding)), encoding);
    }
    EXPECT_EQ(encodingNamed("vq9"), std::nullopt);
}

}  // namespace
}  // namespace filigree::encoding
