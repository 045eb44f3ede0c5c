// Numbers as people read them: the same text in tables, charts and printed lines, whatever the locale.
#pragma once

#include <cstdint>
#include <string>

namespace filigree::report {

// "1,234,567".
std::string formatCount(uint64_t count);

// `decimals` places and grouped thousands: "12,345.68". "-" when not finite.
std::string formatNumber(double value, int decimals);

// Four significant digits at most, thousands as k, M, G: "0.25", "1,024", "12.5k", "3M". "-" when not finite.
std::string formatCompact(double value);

// "512 B", "1.50 KiB", "24.0 MiB". "-" when not finite.
std::string formatBytes(double bytes);

// A share of one in percent: 0.9731 is "97.31 %". What is neither 0 nor 1 never shows as "0.00 %" or "100.00
// %":
// "< 0.01 %" and "> 99.99 %" stand for it. "-" when not finite.
std::string formatShare(double share);

}  // namespace filigree::report
