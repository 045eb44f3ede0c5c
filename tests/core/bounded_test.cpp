// The bound of a Bounded encloses the exact result, and is 0 where nothing was lost.
#include "filigree/core/bounded.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace filigree {
namespace {

// A value in quadruple precision: exact for a few operations on short numbers, and far finer than any bound
// on others.
using Wide = __float128;

// Random numbers, some short and some with all 53 bits, of sizes that differ widely.
class Numbers {
  public:
    explicit Numbers(uint32_t seed) : engine_(seed) {}
    double next() {
        const auto bits = static_cast<int>(engine_() % 53) + 1;
        const double whole = static_cast<double>(engine_() >> (64 - bits));
        const double scaled = std::ldexp(whole, static_cast<int>(engine_() % 40) - 20 - bits);
        return engine_() % 2 == 0 ? scaled : -scaled;
    }
    uint32_t below(uint32_t count) { return static_cast<uint32_t>(engine_() % count); }

  private:
    std::mt19937_64 engine_;
};

void expectEncloses(const Bounded& bounded, Wide exact) {
    const Wide off = exact - Wide(bounded.value());
    const Wide distance = off < 0 ? -off : off;
    // Quadruple precision itself is off by 2^-112 of the value, in each of a few steps.
    const Wide magnitude = exact < 0 ? -exact : exact;
    EXPECT_TRUE(distance <= Wide(bounded.error()) + magnitude * Wide(0x1p-106))
        << bounded.value() << " +- " << bounded.error() << " off by " << static_cast<double>(distance);
}

TEST(Bounded, EnclosesChainsOfOperations) {
    Numbers numbers(1);
    for (int round = 0; round < 20000; ++round) {
        const double first = numbers.next();
        Bounded bounded = first;
        Wide exact = first;
        Wide largest = exact;
        const uint32_t steps = 1 + numbers.below(3);
        for (uint32_t k = 0; k < steps; ++k) {
            const double other = numbers.next();
            switch (numbers.below(4)) {
                case 0:
                    bounded = bounded + other;
                    exact = exact + Wide(other);
                    break;
                case 1:
                    bounded = Bounded(other) - bounded;
                    exact = Wide(other) - exact;
                    break;
                case 2:
                    bounded = bounded * other;
                    exact = exact * Wide(other);
                    break;
                default:
                    if (other == 0) continue;
                    bounded = bounded / other;
                    exact = exact / Wide(other);
            }
            largest = std::max({largest, exact, -exact});
        }
        // Where all but cancels, quadruple precision has lost what was there before.
        if (largest * Wide(0x1p-40) < exact || largest * Wide(0x1p-40) < -exact)
            expectEncloses(bounded, exact);
    }
}

TEST(Bounded, DyadicNumbersStayExact) {
    const Bounded a = 0.375;
    const Bounded b = 1024.5;
    EXPECT_EQ((a + b).error(), 0);
    EXPECT_EQ((a - b).error(), 0);
    EXPECT_EQ((a * b).error(), 0);
    EXPECT_EQ((b / 4.0).error(), 0);
    EXPECT_EQ((a * b - 384.1875).value(), 0);
    EXPECT_TRUE((a * b - 384.1875).certainlyNotNegative());
    EXPECT_FALSE((a * b - 384.1875).certainlyPositive());
}

TEST(Bounded, KnowsWhatRoundingHides) {
    const Bounded third = Bounded(1) / 3.0;
    EXPECT_GT(third.error(), 0);
    const Bounded rest = third * 3.0 - 1.0;  // exactly 0, which cannot be seen
    EXPECT_FALSE(rest.certainlyNegative());
    EXPECT_FALSE(rest.certainlyPositive());
    const Bounded lost = (Bounded(1) + 0x1p-60) - 1.0;
    EXPECT_FALSE(lost.certainlyNegative());
    EXPECT_GE(lost.error(), 0x1p-60);
    EXPECT_TRUE((Bounded(0.3) - 0.2999).certainlyPositive());
}

TEST(Bounded, DividingByWhatMayBeZeroTellsNothing) {
    const Bounded maybeZero = (Bounded(1) / 3.0) * 3.0 - 1.0;
    EXPECT_EQ((Bounded(1) / maybeZero).error(), std::numeric_limits<double>::infinity());
}

TEST(Bounded, TinyProductsDoNotPassForExact) {
    const Bounded tiny = Bounded(1e-200) * Bounded(1e-200);
    EXPECT_GT(tiny.error(), 0);
    EXPECT_FALSE(tiny.certainlyPositive());
    EXPECT_EQ((Bounded(0) * Bounded(1e-200)).error(), 0);
}

}  // namespace
}  // namespace filigree
