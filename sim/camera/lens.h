#pragma once

#include <Eigen/Core>
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

/// A lens before a sensor that may be tilted.
struct Focus {
  double focal_length_m;
  double f_number;
  double pixel_pitch_m;
  double distance_m;  ///< Of what is in focus in the image's centre.
  /// Slopes of the sensor towards the scene, along the image's columns and rows.
  Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();
};

/// Diameter of each pixel's circle of confusion [px], of a thin lens:
///
///     c = |f² (1/z - 1/z_focus) + tilt · x| / (N pitch),   x: place on the sensor [m].
///
/// inverse_distance: 1/z along the optical axis [1/m], of an image of the result's size. First
/// order in f/z. Domain: z ≫ f.
cv::Mat1f CirclesOfConfusion(const cv::Mat1f& inverse_distance, const Focus& focus);

/// Image-plane illuminance per scene luminance on the axis: E/L = π τ / (4 N²) [lx/(cd/m²)].
double IlluminancePerLuminance(const LensOptions& lens);

/// Illumination at the centre of each pixel relative to the axis: natural vignetting, cos⁴ of the
/// ray's angle to the optical axis, times the barrel's, 1 - (1 - corner_illumination) ρ².
cv::Mat1f RelativeIllumination(const RayGrid& rays, const LensOptions& lens);

/// The image E with the light that lens and housing scatter, which is taken to be uniform over the
/// image:  (1 - g) E + g mean(E),  in each channel. What the lens does not see is taken to be as
/// bright as what it sees. Domain: 0 ≤ g ≤ 1; float images.
cv::Mat WithVeilingGlare(const cv::Mat& image, double glare);

}  // namespace fenestra
