#pragma once

#include "experiments/emva/series.h"

namespace fenestra::emva {

/// One exposure of the photon transfer [DN, DN²].
struct TransferPoint {
  double exposure_s;
  double photons;
  double mean;           ///< μ_y
  double variance;       ///< σ_y², temporal
  double dark_mean;      ///< μ_y.dark at the same exposure
  double dark_variance;  ///< σ_y.dark²

  double signal() const { return mean - dark_mean; }
  double light_variance() const { return variance - dark_variance; }
};

/// A spread over the pixels of an image, and its parts by row, column and what is left: standard
/// deviations.
struct NonUniformity {
  double total;
  double row;
  double column;
  double pixel;
};

/// A camera's figures by EMVA 1288 release 4.0 (linear).
struct Results {
  std::vector<TransferPoint> points;  ///< By exposure.
  size_t saturation_point;  ///< Index of the point whose σ_y² is largest, seen from the end.
  size_t last_fit_point;    ///< Index of the last with at most 70 % of the saturation's signal.

  double gain_dn_per_e;        ///< K
  double responsivity;         ///< R [DN per photon]
  double quantum_efficiency;   ///< η = R/K
  double dark_noise_e;         ///< σ_d
  bool dark_noise_is_floor;    ///< σ_y.dark² came out below 0.24 DN²: σ_d may be less.
  double dark_current_e_s;     ///< μ_I by the mean; NaN for fewer than three exposures.
  double saturation_photons;   ///< μ_p.sat
  double saturation_e;         ///< μ_e.sat = η μ_p.sat
  double threshold_photons;    ///< μ_p.min: where the signal equals its noise
  double largest_snr;          ///< √μ_e.sat
  double dynamic_range;        ///< μ_p.sat/μ_p.min
  double linearity_error_min;  ///< Relative deviation from the line, 5 to 95 % of saturation.
  double linearity_error_max;
  NonUniformity dsnu_e;  ///< In the dark [e]
  NonUniformity prnu;    ///< At 50 % of saturation, relative
};

/// Evaluates a series:
///
///     K = slope of σ_y² - σ_y.dark² over μ_y - μ_y.dark,   R = slope of μ_y - μ_y.dark over μ_p,
///     both through the origin, up to 70 % of saturation;
///     σ_d = √(σ_y.dark² - σ_q²)/K at exposure 0 by a line over the dark pairs, σ_q² = 1/12 DN²,
///     σ_y.dark² at least 0.24 DN²;  μ_p.min = (σ_y.dark/K + 1/2)/η;
///     DSNU = s_y.dark/K;  PRNU = √(s_y² - s_y.dark²)/(μ_y - μ_y.dark),
///
/// temporal variances by differences of two images, spatial ones s² of the mean of a stack less
/// what its temporal noise leaves, split into rows, columns and pixels. A part whose variance comes
/// out negative is 0.
///
/// Throws InputError for a series without what this needs: at least three exposures with a bright
/// and a dark pair, one bright and one dark stack, light that reaches saturation.
Results Evaluate(const Series& series, const ImageReader& images);

}  // namespace fenestra::emva
