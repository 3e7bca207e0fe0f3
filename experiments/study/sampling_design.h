#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fenestra {

/// How the trials of a cell are spread over what the study draws.
enum class DesignMethod {
  kMonteCarlo,      ///< Each trial is drawn independently.
  kLatinHypercube,  ///< Each factor has exactly one trial in each of n equally probable strata.
  kSobol,           ///< Points of a Sobol sequence under Owen's scrambling.
  kSensitivity,     ///< Monte-Carlo in rows of which causes are exchanged one by one.
};

inline constexpr DesignMethod kAllDesignMethods[] = {
    DesignMethod::kMonteCarlo, DesignMethod::kLatinHypercube, DesignMethod::kSobol,
    DesignMethod::kSensitivity};

/// "monte_carlo", "latin_hypercube", "sobol", "sensitivity".
const char* ToString(DesignMethod method);
std::optional<DesignMethod> ParseDesignMethod(std::string_view word);

/// Spearman's rank correlation of two drawn factors, in (-1, 1).
struct FactorCorrelation {
  std::string first;
  std::string second;
  double spearman = 0.0;

  bool operator==(const FactorCorrelation&) const = default;
};

/// Sources of randomness that vary together when an error is traced to its causes: drawn factors,
/// and the trial's own random streams kShotSource, kRigSource and kCalibrationSource.
struct Cause {
  std::string name;
  std::vector<std::string> sources;

  bool operator==(const Cause&) const = default;
};

inline constexpr const char* kShotSource = "shot";                ///< Noise of the images.
inline constexpr const char* kRigSource = "rig";                  ///< The rig as built.
inline constexpr const char* kCalibrationSource = "calibration";  ///< Its calibration's error.

/// The design of a part. Factors that no correlation names are independent of all others.
struct SamplingDesign {
  DesignMethod method = DesignMethod::kMonteCarlo;
  std::vector<FactorCorrelation> correlations;
  std::vector<Cause> causes;  ///< For kSensitivity alone; empty with the other methods.

  bool operator==(const SamplingDesign&) const = default;
};

}  // namespace fenestra
