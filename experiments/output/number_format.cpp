#include "experiments/output/number_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

/// Decimals that show `digits` significant digits of the value after rounding, from 0 to `most`.
int Decimals(double value, int digits, int most = 3) {
  for (int decimals = 0; decimals < most; ++decimals) {
    const double scale = std::pow(10.0, decimals);
    const double rounded = std::round(std::abs(value) * scale) / scale;
    if (rounded >= std::pow(10.0, digits - 1 - decimals)) return decimals;
  }
  return most;
}

/// Without the sign of a zero: "-0.000" would suggest a direction.
std::string Fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') text.erase(0, 1);
  return text;
}

}  // namespace

std::string Significant(std::optional<double> value) {
  if (!value) return kAbsent;
  if (!std::isfinite(*value)) return fmt::format("{}", *value);
  if (*value == 0.0) return "0";
  return Fixed(*value, Decimals(*value, 3));
}

std::string WithStandardError(double value, std::optional<double> standard_error,
                              int most_decimals) {
  if (!standard_error) return Significant(value);
  const int decimals = Decimals(*standard_error, 2, most_decimals);
  return fmt::format("{} ± {}", Fixed(value, decimals), Fixed(*standard_error, decimals));
}

std::string Percent(double fraction, int decimals) {
  return fmt::format("{:.{}f} %", 100.0 * fraction, decimals);
}

std::string Percent(const Interval& fractions) {
  return fmt::format("{:.1f}–{:.1f} %", 100.0 * fractions.lower, 100.0 * fractions.upper);
}

std::string Duration(double seconds) {
  if (seconds < 59.95) return fmt::format("{} s", Significant(seconds));
  const auto s = static_cast<int64_t>(std::llround(seconds));
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  const int64_t minutes = std::llround(seconds / 60.0);
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

std::string Bytes(double bytes) {
  if (bytes < 1e6) return fmt::format("{} kB", Significant(bytes / 1e3));
  if (bytes < 1e9) return fmt::format("{} MB", Significant(bytes / 1e6));
  return fmt::format("{} GB", Significant(bytes / 1e9));
}

std::optional<double> ToMilli(std::optional<double> value) {
  if (value) *value *= 1e3;
  return value;
}

std::string Exact(std::optional<double> value) {
  return value ? fmt::format("{}", *value) : std::string();
}

}  // namespace fenestra
