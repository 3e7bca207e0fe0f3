#include "experiments/number_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

/// Decimals that show `digits` significant digits of the value after rounding, from 0 to 3.
int Decimals(double value, int digits) {
  for (int decimals = 0; decimals < 3; ++decimals) {
    const double scale = std::pow(10.0, decimals);
    const double rounded = std::round(std::abs(value) * scale) / scale;
    if (rounded >= std::pow(10.0, digits - 1 - decimals)) return decimals;
  }
  return 3;
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

std::string WithStandardError(double value, std::optional<double> standard_error) {
  if (!standard_error) return Significant(value);
  const int decimals = Decimals(*standard_error, 2);
  return fmt::format("{} ± {}", Fixed(value, decimals), Fixed(*standard_error, decimals));
}

std::string Percent(double fraction) {
  return fmt::format("{:.1f} %", 100.0 * fraction);
}

std::string Percent(const Interval& fractions) {
  return fmt::format("{:.1f}–{:.1f} %", 100.0 * fractions.lower, 100.0 * fractions.upper);
}

std::optional<double> ToMilli(std::optional<double> value) {
  if (value) *value *= 1e3;
  return value;
}

std::string Exact(std::optional<double> value) {
  return value ? fmt::format("{}", *value) : std::string();
}

}  // namespace fenestra
