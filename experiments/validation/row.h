#pragma once

#include <string>
#include <vector>

#include "experiments/validation/plane_figures.h"

namespace fenestra::validation {

/// Where a simulated figure comes from. Only predictions validate.
enum class Origin {
  kPredicted,  ///< No constant was chosen by this recording or its like.
  kFitted,     ///< A constant was chosen so that recordings are met, by this one or others.
  kDesign,     ///< Put in: the comparison checks that it comes out.
  kAssumed,    ///< No recording and no data sheet says.
};

enum class Verdict { kHolds, kMisfit, kNotJudged };

/// A phenomenon, recorded and simulated.
struct Row {
  std::string phenomenon = {};
  std::string recording = {};  ///< File, source and licence; or what else the figure rests on.
  std::string recorded = {};   ///< The figure.
  std::string simulated = {};
  Origin origin = Origin::kPredicted;
  std::string agreement = {};  ///< With its interval.
  Verdict verdict = Verdict::kNotJudged;
};

std::string ToString(Origin origin);
std::string ToString(Verdict verdict);

/// A table, and how many rows of each origin hold.
std::string ToMarkdown(const std::vector<Row>& rows);

/// simulated/recorded, with the interval of 95 % in which it lies if both are alike,
///
///     ln r ∈ ± 1.96 √((σ_s/s)² + (σ_r/r)² + τ²),
///
/// τ: relative standard deviation of the quantity from one recorded unit or place to another. The
/// row holds if 1 is within the interval about the ratio. Domain: positive values.
void JudgeRatio(Row& row, const Estimated& recorded, const Estimated& simulated, double tau);

/// Domain: low < high. The row holds if the simulated figure lies between them, as written.
void JudgeRange(Row& row, double simulated, double low, double high, const std::string& unit);

/// "0.52 ± 0.01 step".
std::string Text(const Estimated& figure, const std::string& unit, int decimals = 2);

}  // namespace fenestra::validation
