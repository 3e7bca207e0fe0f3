#pragma once

#include <optional>
#include <string>

#include "experiments/statistics.h"

namespace fenestra {

/// Numbers as people read them in tables.

/// Stands for a figure that does not exist, such as the bias of no hits.
inline constexpr char kAbsent[] = "—";

/// Three significant digits without an exponent, but whole numbers in full and at most three
/// decimals: 12345, 123, 12.3, 1.23, 0.123, 0.012. "inf", "-inf"; kAbsent for nullopt.
std::string Significant(std::optional<double> value);

/// "-1.23 ± 0.45": the standard error with two significant digits (at most three decimals), the
/// value with as many decimals. Without a standard error, Significant(value).
std::string WithStandardError(double value, std::optional<double> standard_error);

/// "95.0 %".
std::string Percent(double fraction);
/// "90.0–97.9 %".
std::string Percent(const Interval& fractions);

/// Metres to millimetres, seconds to milliseconds.
std::optional<double> ToMilli(std::optional<double> value);

/// The shortest decimal that reads back to the same double; "inf", "-inf"; empty for nullopt.
std::string Exact(std::optional<double> value);

}  // namespace fenestra
