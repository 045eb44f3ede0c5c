// The two arithmetics of the judge: rounded (double) and exact (big integers and unreduced fractions).
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>

namespace filigree::verify {

template <class Number>
struct Point {
    Number x{};
    Number y{};
};

// Unlimited; numbers up to 512 bits need no allocation.
using Big =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<512>, boost::multiprecision::et_off>;

// num / den with den > 0.
struct Fraction {
    Big num;
    Big den;
};

inline bool operator<(const Fraction& a, const Fraction& b) {
    return a.num * b.den < b.num * a.den;
}

inline int64_t floorInt(double value) {
    const auto whole = static_cast<int64_t>(value);
    return whole - (static_cast<double>(whole) > value ? 1 : 0);
}
inline int64_t ceilInt(double value) {
    return -floorInt(-value);
}

inline double quotient(double a, double b) {
    return a / b;
}
inline Fraction quotient(const Big& a, const Big& b) {
    return b < 0 ? Fraction{-a, -b} : Fraction{a, b};
}

inline int64_t floorQuotient(double a, double b) {
    return floorInt(a / b);
}
inline int64_t floorQuotient(const Big& a, const Big& b) {  // b > 0
    Big whole, rest;
    boost::multiprecision::divide_qr(a, b, whole, rest);
    return whole.convert_to<int64_t>() - (rest < 0 ? 1 : 0);
}

// A coordinate where a line crosses another: a double, or a fraction of the same unit as the coordinates.
inline double asPlace(double x) {
    return x;
}
inline Fraction asPlace(const Big& x) {
    return {x, 1};
}

// Where the segment a-b, a.y != b.y, is at height y.
inline double crossing(const Point<double>& a, const Point<double>& b, double y) {
    return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
}
inline Fraction crossing(const Point<Big>& a, const Point<Big>& b, const Big& y) {
    const Big rise = b.y - a.y;
    return quotient(Big(a.x * rise + (y - a.y) * (b.x - a.x)), rise);
}

// The exponent of the lowest set bit of a finite `value`; 0 for 0.
int lowestBit(double value);

// value * 2^shift, which must be an integer.
Big scaled(double value, int shift);

}  // namespace filigree::verify
