// Opacity squares through filigree_lookup.h, against the readers. Every bit pattern is a block.
#include "filigree/quadmap/reader.h"

#include "lookup/compilers.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

using quadmap::Half;
using quadmap::SquareFormat;
using quadmap::SquarePlace;
using quadmap::SquareReader;

constexpr std::array formats{SquareFormat::vq2, SquareFormat::vq2Plus, SquareFormat::vq4,
                             SquareFormat::vq4Plus};

// The region at the triangle's own weights u and v.
unsigned regionOf(const SquareReader& reader, size_t map, SquarePlace place, float u, float v) {
    const std::array<float, 3> weights{1 - u - v, u, v};
    const auto& vertices = quadmap::verticesOf(place);
    return static_cast<unsigned>(reader.at(map, place.half, weights[vertices[1]], weights[vertices[2]]));
}

TEST(LookupHeaderSquares, findWhatTheReaderFinds) {
    std::mt19937 random(11);
    constexpr uint32_t count = 24;
    for (const SquareFormat format : formats) {
        std::vector<uint8_t> bytes(count * blockBytesOf(format));
        for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
        const auto reader = SquareReader::open(format, bytes);
        ASSERT_TRUE(reader.ok());
        for (const lookup_functions* lookup : lookupCompilers()) {
            SCOPED_TRACE(std::string(nameOf(format)) + ", " + lookup->compiler);
            filigree_vq view;
            ASSERT_EQ(lookup->vq_open(&view, FILIGREE_VQ2 + static_cast<unsigned>(format), count,
                                      bytes.data(), bytes.size()),
                      FILIGREE_LOOKUP_OK);
            ASSERT_EQ(view.side, sideOf(format));
            for (uint32_t map = 0; map < count; ++map) {
                for (unsigned k = 0; k < view.side * view.side; ++k) {
                    const unsigned x = k % view.side;
                    const unsigned y = k / view.side;
                    ASSERT_EQ(lookup->vq_at(&view, map, x, y), static_cast<unsigned>(reader->at(map, x, y)));
                }
                for (unsigned k = 0; k < 96; ++k) {
                    const float u = static_cast<float>(random() % 1201) / 1000 - 0.1F;
                    const float v = static_cast<float>(random() % 1201) / 1000 - 0.1F;
                    const SquarePlace place{static_cast<Half>(k % 2), static_cast<uint8_t>(k / 2 % 6)};
                    ASSERT_EQ(lookup->vq_at_point(&view, map, k % 2, u, v),
                              static_cast<unsigned>(reader->at(map, place.half, u, v)));
                    ASSERT_EQ(lookup->vq_at_triangle(&view, map, k % 12, u, v),
                              regionOf(*reader, map, place, u, v));
                }
            }
        }
    }
}

TEST(LookupHeaderSquares, openRefusesOtherSizes) {
    const std::vector<uint8_t> bytes(256);
    filigree_vq view;
    for (const unsigned encoding : {FILIGREE_VQ2, FILIGREE_VQ2_PLUS, FILIGREE_VQ4, FILIGREE_VQ4_PLUS}) {
        const uint32_t count = encoding < FILIGREE_VQ4 ? 8 : 4;
        EXPECT_EQ(filigree_vq_open(&view, encoding, count, bytes.data(), 256), FILIGREE_LOOKUP_OK);
        for (size_t cut = 0; cut < 256; ++cut) {
            EXPECT_EQ(filigree_vq_open(&view, encoding, count, bytes.data(), cut), FILIGREE_LOOKUP_PAYLOAD);
        }
    }
    EXPECT_EQ(filigree_vq_open(&view, FILIGREE_SDAG, 8, bytes.data(), 256), FILIGREE_LOOKUP_ENCODING);
}

}  // namespace
}  // namespace filigree::tests
