#pragma once

#include <opencv2/core.hpp>

#include "renderers/tracing/ray_grid.h"
#include "renderers/tracing/render_types.h"

namespace fenestra {

/// Optics between a scene and its sensor. Distortion is part of the camera model and its rays.
struct LensOptions {
  double f_number = 2.8;
  double transmission = 0.9;
  /// Gaussian point spread of the lens, on the axis and in the image's corners [px], besides the
  /// pixel's own area. Small lenses: 0.3–0.6 px at 6 µm; diffraction alone, with an Airy radius of
  /// 1.22 λ N = 1.9 µm at f/2.8, is 0.1 px.
  double blur_sigma_px = 0.40;
  double corner_blur_sigma_px = 0.60;
  /// Share of the light that reaches the corners through the lens' barrel, besides cos⁴.
  double corner_illumination = 0.9;
  /// Veiling glare index after ISO 9358: illuminance of a small black patch's image over that of
  /// the bright field around it. Assumed: 2–5 % are usual for small lenses before a bare sensor.
  double veiling_glare = 0.03;
};

/// A Gaussian point spread whose variance grows with the square of the distance from the image's
/// centre:  σ²(ρ) = σ₀² + (σ₁² - σ₀²) ρ²,  ρ = 1 in the corners.
struct PointSpread {
  double centre_sigma_px;
  double corner_sigma_px;
};

/// Image-plane illuminance per scene luminance on the axis: E/L = π τ / (4 N²) [lx/(cd/m²)].
double IlluminancePerLuminance(const LensOptions& lens);

/// Illumination at the centre of each pixel relative to the axis: natural vignetting, cos⁴ of the
/// ray's angle to the optical axis, times the barrel's, 1 - (1 - corner_illumination) ρ².
cv::Mat1f RelativeIllumination(const RayGrid& rays, const LensOptions& lens);

/// The image E with the light that lens and housing scatter, which is taken to be uniform over the
/// image:  (1 - g) E + g mean(E),  in each channel. What the lens does not see is taken to be as
/// bright as what it sees. Domain: 0 ≤ g ≤ 1; float images.
cv::Mat WithVeilingGlare(const cv::Mat& image, double glare);

/// The image that pixels integrate behind a lens: the mean over each pixel's area of the image
/// convolved with a point spread. The light must be known by quarters of pixels: blurring whole
/// pixels would displace edges along rows by up to 0.03 px.
///
/// One kernel over the quarters, of a Gaussian and the pixel's square, has the discrete variance
/// σ₀² + 1/16, which with the quarters' own 1/48 is that of the optics and the pixel, σ₀² + 1/12.
/// Three-tap kernels whose discrete variances add up to σ² - σ₀², exactly, at every pixel follow.
/// The border is replicated. Domain: 0 ≤ σ₀ ≤ σ₁ ≤ 20 px; float images of one size and number of
/// channels, which the result has too.
cv::Mat Gather(const QuarterImages& quarters, const PointSpread& spread);

}  // namespace fenestra
