// Encoders: always conservative, always the same, and as good as they say.
#include "filigree/quadmap/encode.h"

#include "filigree/core/target.h"
#include "filigree/quadmap/reader.h"

#include "quadmap/vq2_best.h"
#include "quadmap/vq4_words.h"
#include "sample_squares.h"

#include <bit>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace filigree::quadmap {
namespace {

using Bytes = std::vector<uint8_t>;

struct Encoder {
    const char* name;
    SquareFormat format;
    std::function<Bytes(const Square&, Prefer)> encode;
};

template <class Block>
Bytes bytesOf(const Block& block) {
    return {block.begin(), block.end()};
}

std::vector<Encoder> encoders() {
    using enum SquareFormat;
    const auto forVq2 = [](Vq2Method method) {
        return [=](const Square& s, Prefer p) { return bytesOf(encodeVq2(s, method, p)); };
    };
    const auto forVq4 = [](Vq4Method method) {
        return [=](const Square& s, Prefer p) { return bytesOf(encodeVq4(s, method, p)); };
    };
    const auto forVq4Plus = [](Vq4Method method) {
        return [=](const Square& s, Prefer p) { return bytesOf(encodeVq4Plus(s, method, p)); };
    };
    return {{"vq2 literal", vq2, forVq2(Vq2Method::paperLiteral)},
            {"vq2 sensible", vq2, forVq2(Vq2Method::paperSensible)},
            {"vq2 best", vq2, forVq2(Vq2Method::best)},
            {"vq2+", vq2Plus, [](auto& s, Prefer p) { return bytesOf(encodeVq2Plus(s, p)); }},
            {"vq4 paper", vq4, forVq4(Vq4Method::paper)},
            {"vq4 fast", vq4, forVq4(Vq4Method::fast)},
            {"vq4 best", vq4, forVq4(Vq4Method::best)},
            {"vq4+ paper", vq4Plus, forVq4Plus(Vq4Method::paper)},
            {"vq4+ fast", vq4Plus, forVq4Plus(Vq4Method::fast)},
            {"vq4+ best", vq4Plus, forVq4Plus(Vq4Method::best)}};
}

Square decoded(SquareFormat format, const Bytes& block) {
    return SquareReader::open(format, block)->decode(0);
}

unsigned samplesOf(const Encoder& encoder) {
    const bool slow = sideOf(encoder.format) == 32 && !std::string_view(encoder.name).ends_with("fast");
    return slow ? 7 : 16;
}

TEST(Encoders, AreConservative) {
    for (const Encoder& encoder : encoders()) {
        for (const Square& square : sampleSquares(sideOf(encoder.format), samplesOf(encoder))) {
            for (const Prefer prefer : {Prefer::neither, Prefer::transparent}) {
                const Square map = decoded(encoder.format, encoder.encode(square, prefer));
                ASSERT_TRUE(isConservative(square, map)) << encoder.name;
            }
        }
    }
}

TEST(Encoders, GiveTheSameBlocksOnEachTarget) {
    std::mt19937 random(5);
    const Square leaf = leafySquare(16, random);
    for (const Encoder& encoder : encoders()) {
        // A small leaf in one corner, so that the scalar target is done in time.
        Square cornered(sideOf(encoder.format), Region::transparent);
        for (unsigned at = 0; at < 256; ++at) cornered.at(at % 16, at / 16) = leaf.regions[at];
        std::vector<Square> squares{cornered};
        if (std::getenv("FILIGREE_FULL") != nullptr) squares = sampleSquares(sideOf(encoder.format), 5);
        for (const Square& square : squares) {
            const Bytes block = encoder.encode(square, Prefer::neither);
            ASSERT_TRUE(forceTarget("scalar").ok());
            EXPECT_EQ(encoder.encode(square, Prefer::neither), block) << encoder.name;
            ASSERT_TRUE(forceTarget("best").ok());
        }
    }
}

TEST(Encoders, KeepUniformSquaresWhole) {
    for (const Encoder& encoder : encoders()) {
        const unsigned side = sideOf(encoder.format);
        for (const Region region : {Region::transparent, Region::mixed, Region::opaque}) {
            const Square square(side, region);
            EXPECT_EQ(decoded(encoder.format, encoder.encode(square, Prefer::neither)), square)
                << encoder.name;
        }
    }
}

TEST(Encoders, FreeRegionsCostNothing) {
    // The free half may join in a uniform word, so that nothing is lost.
    for (const Encoder& encoder : encoders()) {
        const Square square = halfOf(Square(sideOf(encoder.format), Region::opaque));
        const Square map = decoded(encoder.format, encoder.encode(square, Prefer::neither));
        EXPECT_EQ(substitutions(square, map), 0u) << encoder.name;
    }
}

TEST(Encoders, BetterOnesAreBetter) {
    std::map<std::string, uint32_t> sums;
    std::mt19937 random(7);
    for (int k = 0; k < 3; ++k) {
        const Square large = leafySquare(32, random);
        const Square small = leafySquare(16, random);
        for (const Encoder& encoder : encoders()) {
            const Square& square = sideOf(encoder.format) == 32 ? large : small;
            sums[encoder.name] +=
                substitutions(square, decoded(encoder.format, encoder.encode(square, Prefer::neither)));
        }
    }
    EXPECT_LE(sums["vq2 best"], sums["vq2 sensible"]);
    EXPECT_LE(sums["vq2 best"], sums["vq2 literal"]);
    EXPECT_LE(sums["vq2+"], sums["vq2 best"]);
    EXPECT_LE(sums["vq4 best"], sums["vq4 fast"]);
    EXPECT_LE(sums["vq4 best"], sums["vq4 paper"]);
    EXPECT_LE(sums["vq4+ best"], sums["vq4 best"]);
}

uint32_t lost(const Square& source, const Square& map, Region state) {
    uint32_t count = 0;
    for (size_t k = 0; k < source.regions.size(); ++k) {
        count += source.regions[k] == state && map.regions[k] != state ? 1 : 0;
    }
    return count;
}

TEST(Encoders, PreferWhatTheyAreTold) {
    std::mt19937 random(8);
    uint32_t transparentLost = 0;
    uint32_t opaqueLost = 0;
    uint32_t transparentWhenPreferred = 0;
    uint32_t opaqueWhenPreferred = 0;
    for (int k = 0; k < 20; ++k) {
        const Square square = leafySquare(16, random);
        const auto map = [&](Prefer prefer) {
            return decoded(SquareFormat::vq2, bytesOf(encodeVq2(square, Vq2Method::best, prefer)));
        };
        transparentLost += lost(square, map(Prefer::neither), Region::transparent);
        opaqueLost += lost(square, map(Prefer::neither), Region::opaque);
        transparentWhenPreferred += lost(square, map(Prefer::transparent), Region::transparent);
        opaqueWhenPreferred += lost(square, map(Prefer::opaque), Region::opaque);
    }
    EXPECT_LT(transparentWhenPreferred, transparentLost);
    EXPECT_LT(opaqueWhenPreferred, opaqueLost);
}

// The least loss over all transforms and all codebooks of `words`, by trying them: no orbits, no bounds.
// Quadrants are still taken one by one.
class Exhaustive {
  public:
    explicit Exhaustive(std::vector<Word2> words) : words_(std::move(words)) {}

    uint32_t leastLoss(const Square& square) const {
        const auto quadrants = quadrantsOf(square);
        uint32_t least = UINT32_MAX;
        for (size_t a = 0; a < words_.size(); ++a) {
            for (size_t b = a + 1; b < words_.size(); ++b) {
                for (size_t c = b + 1; c < words_.size(); ++c) {
                    uint32_t loss = 0;
                    for (unsigned q = 0; q < 4 && loss < least; ++q) {
                        loss += lossOf(quadrants[q], {words_[a], words_[b], words_[c]}, q == 0 ? 1 : 8);
                    }
                    least = std::min(least, loss);
                }
            }
        }
        return least;
    }

  private:
    static Word2 shown(Transform transform, Word2 word) {
        return static_cast<Word2>((word & 16) | transformedCells(transform, 2, word & 15U));
    }
    static uint32_t gainOfAll(const Vector2& vector, std::initializer_list<Word2> words) {
        uint32_t most = 0;
        for (const Word2 word : words) most = std::max(most, gainOf(vector, word, {}));
        return most;
    }
    uint32_t lossOf(const Quadrant2& vectors, const std::array<Word2, 3>& shared, unsigned transforms) const {
        uint32_t known = 0;
        for (const Vector2& v : vectors) known += std::popcount(v.transparent) + std::popcount(v.opaque);
        uint32_t most = 0;
        for (Transform t = 0; t < transforms; ++t) {
            for (size_t a = 0; a < words_.size(); ++a) {
                for (size_t b = a + 1; b < words_.size(); ++b) {
                    uint32_t gain = 0;
                    for (const Vector2& vector : vectors) {
                        gain +=
                            gainOfAll(vector, {Word2{15}, Word2{31}, shown(t, shared[0]), shown(t, shared[1]),
                                               shown(t, shared[2]), words_[a], words_[b]});
                    }
                    most = std::max(most, gain);
                }
            }
        }
        return known - most;
    }

    std::vector<Word2> words_;
};

// Small cases: where nothing is opaque, the 14 transparent words are all that can help.
TEST(Vq2Best, IsTheOptimum) {
    std::vector<Word2> words;
    for (Word2 word = 1; word < 15; ++word) words.push_back(word);
    const Exhaustive exhaustive(words);
    std::mt19937 random(9);
    for (int k = 0; k < 10; ++k) {
        Square square = k == 0 ? leafySquare(16, random) : Square(16);
        for (unsigned at = 0; at < 256; ++at) {
            Region& region = square.regions[at];
            if (region == Region::opaque) region = Region::mixed;
            // Few vectors a quadrant, so that the trial is quick.
            if (k > 0 && at / 32 % 2 == 0 && at % 4 < 2) region = static_cast<Region>(random() % 2);
        }
        const Square map = decoded(SquareFormat::vq2, bytesOf(encodeVq2(square, Vq2Method::best)));
        EXPECT_EQ(substitutions(square, map), exhaustive.leastLoss(square));
    }
}

TEST(Vq4Words, FitTheirPlaces) {
    // transparent, opaque
    const States4 simple{0x1234, 0};
    const States4 halves{0x0001, 0x8000};
    const States4 vertical{0x1111, 0x8888};
    const States4 horizontal{0x000f, 0xf000};
    const States4 generic{0x0001, 0x8800 | 0x0080 | 0x1000};
    EXPECT_EQ(shapeOf(simple), Shape4::simple);
    EXPECT_EQ(shapeOf(halves), Shape4::halves);
    EXPECT_EQ(shapeOf(vertical), Shape4::vertical);
    EXPECT_EQ(shapeOf(horizontal), Shape4::horizontal);
    EXPECT_EQ(shapeOf(generic), Shape4::generic);
    // simple, halves, vertical, horizontal, generic
    EXPECT_TRUE(fits({3, 0, 1, 1, 8}, Vq4Layout::vq4));
    EXPECT_TRUE(fits({13, 0, 0, 0, 0}, Vq4Layout::vq4));
    EXPECT_TRUE(fits({3, 10, 0, 0, 0}, Vq4Layout::vq4));
    EXPECT_FALSE(fits({3, 0, 2, 0, 8}, Vq4Layout::vq4));
    EXPECT_FALSE(fits({4, 0, 0, 0, 9}, Vq4Layout::vq4));
    EXPECT_TRUE(fits({8, 0, 1, 1, 3}, Vq4Layout::vq4Plus));
    EXPECT_FALSE(fits({8, 2, 1, 1, 2}, Vq4Layout::vq4Plus));
    EXPECT_EQ(reduced({0x00ff, 0x1000}, Word4Kind::simple), (States4{0x00ff, 0}));
}

}  // namespace
}  // namespace filigree::quadmap
