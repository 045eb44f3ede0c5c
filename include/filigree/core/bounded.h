// Real numbers in double precision that know how wrong they may be.
#pragma once

#include <cmath>
#include <limits>

namespace filigree {

// A value and a proven bound of its distance to the exact result of the operations that made it. Operations
// that lose nothing keep the bound at 0, so exact inputs in easy positions (dyadic coordinates, say) are
// decided exactly. Running error analysis with error-free transformations: Ogita, Rump, Oishi, "Accurate sum
// and dot product", 2005.
class Bounded {
  public:
    Bounded() = default;
    Bounded(double exact) : value_(exact) {}

    [[nodiscard]] double value() const { return value_; }
    [[nodiscard]] double error() const { return error_; }

    // True when the sign is certain.
    [[nodiscard]] bool certainlyNegative() const { return value_ < -error_; }
    [[nodiscard]] bool certainlyPositive() const { return value_ > error_; }
    [[nodiscard]] bool certainlyNotNegative() const { return value_ >= error_; }

    friend Bounded operator-(const Bounded& a) { return {-a.value_, a.error_}; }
    friend Bounded operator+(const Bounded& a, const Bounded& b) {
        const double sum = a.value_ + b.value_;
        const double part = sum - a.value_;
        const double lost = (a.value_ - (sum - part)) + (b.value_ - part);
        return {sum, above(a.error_ + b.error_ + std::fabs(lost))};
    }
    friend Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }
    friend Bounded operator*(const Bounded& a, const Bounded& b) {
        const double product = a.value_ * b.value_;
        const double lost = std::fma(a.value_, b.value_, -product);
        const double spread =
            std::fabs(a.value_) * b.error_ + std::fabs(b.value_) * a.error_ + a.error_ * b.error_;
        const bool tiny = std::fabs(product) < smallest && a.value_ != 0 && b.value_ != 0;
        return {product, above(spread + std::fabs(lost) + (tiny ? smallest : 0))};
    }
    // `b` must not be able to be 0; the bound is infinite where it can.
    friend Bounded operator/(const Bounded& a, const Bounded& b) {
        const double quotient = a.value_ / b.value_;
        const double lost = std::fabs(std::fma(-quotient, b.value_, a.value_));
        const double least = std::fabs(b.value_) - b.error_;
        if (!(least > 0)) return {quotient, std::numeric_limits<double>::infinity()};
        const double spread = lost + a.error_ + std::fabs(quotient) * b.error_;
        return {quotient, spread == 0 ? 0 : above(spread / (least * (1 - 1e-15)))};
    }

  private:
    Bounded(double value, double error) : value_(value), error_(error) {}

    // Products below this lose bits that an fma cannot recover.
    static constexpr double smallest = 1e-280;

    // An upper bound of a sum of non-negative terms that was rounded a few times.
    static double above(double error) { return error * (1 + 1e-14); }

    double value_ = 0;
    double error_ = 0;
};

}  // namespace filigree
