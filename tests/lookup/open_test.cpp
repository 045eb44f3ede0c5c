// What open() of filigree_lookup.h refuses.
#include "filigree/encoding/bitmask.h"

#include "encoding/encoding_name.h"
#include "encoding/sample_maps.h"
#include "exact_bytes.h"
#include "lookup/compilers.h"

#include <cstring>
#include <string>

#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

using encoding::EncodedSet;
using encoding::EncodedView;
using encoding::Encoding;
using micromap::Format;

std::vector<EncodedSet> smallSets() {
    std::vector<EncodedSet> sets;
    for (const Format format : {Format::twoState, Format::fourState}) {
        for (const Encoding encoding : testedEncodings)
            sets.push_back(encodeGood(encoding, smallSet(), format));
        const std::vector<uint8_t> texels(35, 200);
        const image::AlphaTexture texture{image::alphaImageFrom8Bit(7, 5, texels)};
        const std::vector<encoding::BitmaskSource> sources(3, {&texture, {}});
        sets.push_back(*encoding::encodeBitmasks(sources, format, serialExecutor()));
    }
    return sets;
}

filigree_lookup_error openExactly(const EncodedView& set) {
    const ExactBytes descriptors(set.descriptors);
    const ExactBytes payload(set.payload);
    filigree_view view;
    return openView(*lookup_functions_c99(), view,
                    {set.encoding, set.format, set.mapCount, descriptors.view(), payload.view()});
}

TEST(LookupHeaderOpen, refusesCutBlocks) {
    for (const EncodedSet& set : smallSets()) {
        SCOPED_TRACE(std::string(nameOf(set.encoding)));
        const EncodedView whole = viewOf(set);
        ASSERT_EQ(openExactly(whole), FILIGREE_LOOKUP_OK);
        for (size_t bytes = 0; bytes < set.descriptors.size(); ++bytes) {
            EncodedView cut = whole;
            cut.descriptors = cut.descriptors.first(bytes);
            ASSERT_EQ(openExactly(cut), FILIGREE_LOOKUP_DESCRIPTORS) << bytes;
        }
        for (size_t bytes = 0; bytes < set.payload.size(); ++bytes) {
            EncodedView cut = whole;
            cut.payload = cut.payload.first(bytes);
            ASSERT_NE(openExactly(cut), FILIGREE_LOOKUP_OK) << bytes;
        }
        EncodedSet longer = set;
        longer.payload.resize(longer.payload.size() + 4);
        EXPECT_NE(openExactly(viewOf(longer)), FILIGREE_LOOKUP_OK);
    }
}

TEST(LookupHeaderOpen, refusesWrongNumbers) {
    for (const EncodedSet& set : smallSets()) {
        SCOPED_TRACE(std::string(nameOf(set.encoding)));
        EncodedView wrong = viewOf(set);
        for (const uint32_t maps : {0U, set.mapCount + 64, UINT32_MAX}) {
            wrong.mapCount = maps;
            EXPECT_NE(openExactly(wrong), FILIGREE_LOOKUP_OK) << maps;
        }
        wrong = viewOf(set);
        for (const unsigned format : {0U, 3U, 65535U}) {
            wrong.format = static_cast<Format>(format);
            EXPECT_EQ(openExactly(wrong), FILIGREE_LOOKUP_ENCODING);
        }
        wrong = viewOf(set);
        wrong.encoding = static_cast<Encoding>(FILIGREE_VQ2);
        EXPECT_EQ(openExactly(wrong), FILIGREE_LOOKUP_ENCODING);
    }
}

TEST(LookupHeaderOpen, refusesNullPointersWithCounts) {
    for (const EncodedSet& set : smallSets()) {
        EncodedView null = viewOf(set);
        filigree_view view;
        null.payload = {static_cast<const uint8_t*>(nullptr), set.payload.size()};
        EXPECT_EQ(openView(*lookup_functions_c99(), view, null), FILIGREE_LOOKUP_NULL);
        null = viewOf(set);
        null.descriptors = {static_cast<const uint8_t*>(nullptr), set.descriptors.size()};
        EXPECT_EQ(openView(*lookup_functions_c99(), view, null), FILIGREE_LOOKUP_NULL);
    }
    filigree_vq squares;
    EXPECT_EQ(filigree_vq_open(&squares, FILIGREE_VQ2, 1, nullptr, 32), FILIGREE_LOOKUP_NULL);
    filigree_fil fil;
    EXPECT_EQ(filigree_fil_open(&fil, nullptr, 100), FILIGREE_LOOKUP_NULL);
    EXPECT_EQ(filigree_fil_open(&fil, nullptr, 0), FILIGREE_LOOKUP_FILE);
}

TEST(LookupHeaderOpen, hasATextForEachError) {
    std::vector<std::string> texts;
    for (int error = 0; error <= FILIGREE_LOOKUP_MISSING; ++error) {
        texts.emplace_back(filigree_lookup_error_text(static_cast<filigree_lookup_error>(error)));
        for (size_t k = 0; k + 1 < texts.size(); ++k) EXPECT_NE(texts[k], texts.back());
    }
}

}  // namespace
}  // namespace filigree::tests
