#pragma once

#include <optional>
#include <string>

#include "experiments/statistics/moments.h"

namespace fenestra {

/// Numbers as people read them in tables.

/// Stands for a figure that does not exist, such as the bias of no hits.
inline constexpr char kAbsent[] = "—";

/// Three significant digits without an exponent, but whole numbers in full and at most three
/// decimals: 12345, 123, 12.3, 1.23, 0.123, 0.012. "inf", "-inf"; kAbsent for nullopt.
std::string Significant(std::optional<double> value);

/// "-1.23 ± 0.45": the standard error with two significant digits (at most `most_decimals`), the
/// value with as many decimals. Without a standard error, Significant(value).
std::string WithStandardError(double value, std::optional<double> standard_error,
                              int most_decimals = 3);

/// "95.0 %".
std::string Percent(double fraction, int decimals = 1);
/// "90.0–97.9 %".
std::string Percent(const Interval& fractions);

/// "0.12 s", "59.3 s", "12 min 34 s", "3 h 00 min".
std::string Duration(double seconds);

/// "12.3 kB", "123 MB", "1.23 GB", of 1000 bytes, 1000² and 1000³.
std::string Bytes(double bytes);

/// Metres to millimetres, seconds to milliseconds.
std::optional<double> ToMilli(std::optional<double> value);

/// The shortest decimal that reads back to the same double; "inf", "-inf"; empty for nullopt.
std::string Exact(std::optional<double> value);

}  // namespace fenestra
