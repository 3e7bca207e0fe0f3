#pragma once

#include <Eigen/Core>
#include <vector>

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

}  // namespace fenestra
