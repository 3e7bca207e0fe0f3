#pragma once

#include <optional>

#include "vision/frame/blurred_step.h"
#include "vision/frame/edge_strips.h"

namespace fenestra {

/// The step that fits best to a strip's pixels by weighted least squares:
///
///     I = a + g (P(s - s0) + t dP/dσ + β_out R(s - s0) - β_in R(s0 - s)),
///     t = blur_change τ + blur_bend (τ² - 1/3),   τ from -1 to 1 along the side,
///
/// with P the blurred step and R its ramp (blurred_step.h). a, g and s0 are the strip's own; blur
/// and slopes β belong to the whole side and are given. What is at full scale says only that the
/// light was not less: such a pixel counts where the model is below full scale, and not where it is
/// above. Where there are such pixels, steps along a side are known to be nearly alike.
struct StepFit {
  double base_dn = 0.0;
  double rise_dn = 0.0;
  double s0_px = 0.0;
  double s0_variance = 0.0;  ///< For the weights as they are.
  double mean_square = 0.0;  ///< Weighted, per degree of freedom.
};

/// What the model says of a pixel, and by what.
struct StepValue {
  double p;  ///< Share of the outer grey value.
  double grey_dn;
  Eigen::Vector3d by_own;    ///< a, g, s0.
  Eigen::Vector3d by_shape;  ///< g's factors: dP/dσ, R(s - s0), -R(s0 - s).
  double weight;
  bool counts;
};
using BySharedTuning = Eigen::Matrix<double, EdgeTuning::kShared, 1>;
using SharedByShape = Eigen::Matrix<double, EdgeTuning::kShared, 3>;

/// Spread of the steps along one side, as a share of them.
inline constexpr double kRiseSpread = 0.03;

class StepModel {
 public:
  StepModel(const SideRequest& request, const EdgeTuning& tuning, const Eigen::Vector2d& normal);

  StepValue At(const StepFit& fit, double share, const StripPixel& pixel) const;
  /// What all strips of the side share moves their greys by these combinations of `by_shape`.
  static SharedByShape LineariseShared(const StepFit& fit, double share);
  /// nullopt where there is no such edge within 0.7 of the reach.
  std::optional<StepFit> Fit(const EdgeStrip& strip) const;
  /// Information on a strip's own unknowns from the rest of the side.
  Eigen::Matrix3d PriorInformation(const EdgeStrip& strip) const;

 private:
  std::optional<StepFit> Start(const EdgeStrip& strip) const;

  SideRequest request_;
  EdgeTuning tuning_;
  BlurredStep step_;
};

}  // namespace fenestra
