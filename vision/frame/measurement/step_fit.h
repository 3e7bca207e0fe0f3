#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vision/frame/measurement/side_sampling.h"

namespace fenestra {

/// The edge between two uniform areas as pixels see it: a step, blurred by a Gaussian and
/// integrated over square pixels. With s [px] the pixel's distance from the edge along its unit
/// normal n,
///
///     P(s) = (F(s + h) - F(s - h)) / 2h,   F(s) = s Φ(s/σ') + σ' φ(s/σ'),
///     h = max(|n_u|, |n_v|) / 2,           σ'² = σ² + min(|n_u|, |n_v|)² / 12:
///
/// The pixel's longer extent across the edge is integrated; the shorter one enters by its variance,
/// which is exact for edges along rows and columns. P goes from 0 to 1.
///
/// The ramp of the edge grows with s on the outer side only: R(s) = s Φ(s/σ") + σ" φ(s/σ"), σ"² =
/// σ² + 1/12.
class BlurredStep {
 public:
  /// Domain: sigma_px > 0.
  BlurredStep(double sigma_px, const Eigen::Vector2d& normal);

  struct Value {
    double p;
    double by_s;      ///< [1/px]
    double by_sigma;  ///< [1/px]
    double ramp;      ///< R [px].
  };
  /// Interpolates linearly in a table; accurate to 1e-4.
  Value At(double s_px) const;

 private:
  double reach_px_;  // Farther away P is 0 or 1 to 1e-6.
  std::vector<Value> table_;
};

/// The step that best fits the pixels of a strip in the sense of weighted least squares:
///
///     I = a + g (P(s - s0) + t dP/dσ + β_out R(s - s0) - β_in R(s0 - s)),
///     t = blur_change τ + blur_bend (τ² - 1/3),   τ from -1 to 1 along the side,
///
/// with P the blurred step and R its ramp (BlurredStep). Each strip has its own a, g and s0; the
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
using BySharedNuisance = Eigen::Matrix<double, EdgeNuisance::kShared, 1>;
using SharedByShape = Eigen::Matrix<double, EdgeNuisance::kShared, 3>;

/// Relative standard deviation of the steps along one side.
inline constexpr double kRiseSpread = 0.03;

class StepModel {
 public:
  StepModel(const SideRequest& request, const EdgeNuisance& nuisance,
            const Eigen::Vector2d& normal);

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
  EdgeNuisance nuisance_;
  BlurredStep step_;
};

}  // namespace fenestra
