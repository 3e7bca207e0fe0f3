#pragma once

#include <stdexcept>
#include <string>

#include "experiments/check/limit.h"

namespace fenestra {

/// A fault in the text of a limit, as a sentence that names the word and what is allowed.
class LimitTextError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads a limit:
///
///     limit     = metric ("<=" | ">=") limit ["with" "confidence" number] ["in" "each" "cell"]
///                 ["where" condition {"and" condition}]
///     metric    = "rate" "(" outcome ")" | statistic "(" quantity ")" | name (see Metrics)
///     statistic = "p50" ... "p99.9" | "median" | "rmse" | "trimmed_rmse" | "bias"
///     limit     = number | number "times" "baseline" | "baseline" [("+" | "-") number]
///     condition = name ("=" | "!=" | "<" | "<=" | ">" | ">=") value
///               | name "in" "[" value {"," value} "]"
///
/// as in  p95(centroid_error_mm) <= 15 with confidence 0.95 where detector = edge-stereo and
/// distance_m <= 3. Times baseline is for rmse, baseline ± number for rates.
///
/// Throws LimitTextError. Names of factors and their values are checked, those of detectors and
/// parts are not: only a study can tell.
Limit ParseLimit(const std::string& text, double default_confidence);

/// Reads what stands behind "where" alone:  condition {"and" condition}.
std::vector<Condition> ParseConditions(const std::string& text);

}  // namespace fenestra
