#include "filigree/report/number.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace filigree::report {

namespace {

// Commas between thousands in the whole part of a decimal number.
std::string grouped(std::string digits) {
    const size_t point = digits.find('.');
    const size_t first = digits.starts_with('-') ? 1 : 0;
    size_t at = point == std::string::npos ? digits.size() : point;
    while (at > first + 3) {
        at -= 3;
        digits.insert(at, ",");
    }
    return digits;
}

// "1.50" as "1.5", "2.00" as "2".
std::string trimmed(std::string digits) {
    if (digits.find('.') == std::string::npos) return digits;
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.ends_with('.')) digits.pop_back();
    return digits;
}

// Decimals that leave about `significant` digits, for magnitudes below a thousand or so.
int decimalsFor(double magnitude, int significant) {
    if (magnitude == 0) return 0;
    const int whole = static_cast<int>(std::floor(std::log10(magnitude))) + 1;
    return std::max(0, significant - std::max(whole, -6));
}

}  // namespace

std::string formatCount(uint64_t count) {
    return grouped(std::to_string(count));
}

std::string formatNumber(double value, int decimals) {
    if (!std::isfinite(value)) return "-";
    return grouped(fmt::format("{:.{}f}", value, decimals));
}

std::string formatCompact(double value) {
    if (!std::isfinite(value)) return "-";
    const double magnitude = std::abs(value);
    if (magnitude < 9999.5) return grouped(trimmed(fmt::format("{:.{}f}", value, decimalsFor(magnitude, 4))));
    constexpr std::array<const char*, 4> suffix = {"k", "M", "G", "T"};
    double scaled = value;
    size_t step = 0;
    for (scaled /= 1000; std::abs(scaled) >= 999.5 && step + 1 < suffix.size(); ++step) scaled /= 1000;
    return grouped(trimmed(fmt::format("{:.{}f}", scaled, decimalsFor(std::abs(scaled), 3)))) + suffix[step];
}

std::string formatBytes(double bytes) {
    if (!std::isfinite(bytes)) return "-";
    if (std::abs(bytes) < 1024) return fmt::format("{:.0f} B", bytes);
    constexpr std::array<const char*, 4> unit = {"KiB", "MiB", "GiB", "TiB"};
    double scaled = bytes / 1024;
    size_t step = 0;
    for (; std::abs(scaled) >= 1023.5 && step + 1 < unit.size(); ++step) scaled /= 1024;
    return fmt::format("{} {}", grouped(fmt::format("{:.{}f}", scaled, decimalsFor(std::abs(scaled), 3))),
                       unit[step]);
}

std::string formatShare(double share) {
    if (!std::isfinite(share)) return "-";
    if (share > 0 && share < 0.00005) return "< 0.01 %";
    if (share < 1 && share > 0.99995) return "> 99.99 %";
    return fmt::format("{:.2f} %", share * 100);
}

}  // namespace filigree::report
