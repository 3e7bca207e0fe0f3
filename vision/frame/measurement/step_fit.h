#pragma once

#include <optional>

#include "vision/frame/measurement/blurred_step.h"
#include "vision/frame/measurement/edge_strips.h"

namespace fenestra {

/// The step that best fits the pixels of a strip in the sense of weighted least squares:
///
///     I = a + g (P(s - s0) + t dP/dσ + β_out R(s - s0) - β_in R(s0 - s)),
///     t = blur_change τ + blur_bend (τ² - 1/3),   τ from -1 to 1 along the side,
///
/// with P the blurred step and R its ramp (blurred_step.h). Each strip has its own a, g and s0; the
/// blur and the slopes β belong to the whole side and are given. A pixel at full scale only says
/// that the light was at least as bright, so it counts where the model is below full scale and not
/// where it is above. On sides with such pixels, the steps g are assumed to be nearly equal.
struct StepFit {
  double base_dn = 0.0;
  double rise_dn = 0.0;
  double s0_px = 0.0;
  double s0_variance = 0.0;  ///< Variance of s0_px for the weights as they are.
  double mean_square = 0.0;  ///< Weighted mean square of the residuals per degree of freedom.
};

/// The model's value for a pixel and its derivatives.
struct StepValue {
  double p;  ///< P, the share of the outer grey value.
  double grey_dn;
  Eigen::Vector3d by_own;    ///< Derivatives with respect to a, g, s0.
  Eigen::Vector3d by_shape;  ///< Factors of g: dP/dσ, R(s - s0), -R(s0 - s).
  double weight;
  bool counts;
};
using BySharedTuning = Eigen::Matrix<double, EdgeTuning::kShared, 1>;
using SharedByShape = Eigen::Matrix<double, EdgeTuning::kShared, 3>;

/// Relative standard deviation of the steps along one side.
inline constexpr double kRiseSpread = 0.03;

class StepModel {
 public:
  StepModel(const SideRequest& request, const EdgeTuning& tuning, const Eigen::Vector2d& normal);

  StepValue At(const StepFit& fit, double share, const StripPixel& pixel) const;
  /// Derivatives of a pixel's grey value with respect to the parameters that all strips of the side
  /// share, as combinations of `by_shape`.
  static SharedByShape LineariseShared(const StepFit& fit, double share);
  /// Returns nullopt if there is no such edge within 0.7 of the reach.
  std::optional<StepFit> Fit(const EdgeStrip& strip) const;
  /// Prior information on a strip's own unknowns from the rest of the side.
  Eigen::Matrix3d PriorInformation(const EdgeStrip& strip) const;

 private:
  std::optional<StepFit> Start(const EdgeStrip& strip) const;

  SideRequest request_;
  EdgeTuning tuning_;
  BlurredStep step_;
};

}  // namespace fenestra
