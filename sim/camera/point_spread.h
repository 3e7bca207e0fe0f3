#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "renderers/tracing/render_types.h"

namespace fenestra {

/// A point spread by its moments about its own centroid, whose place distortion tells. Variance of
/// each axis:
///
///     σ² = σ₀² + (σ₁² - σ₀²) ρ² + c²/16,
///
/// ρ: place from the image's centre, of length 1 in the corners; c: diameter of the circle of
/// confusion. Third moments are those of third-order coma: a ray through the pupil at radius r and
/// angle φ arrives S r² (2 + cos 2φ) along the vector S and S r² sin 2φ across it. Over a uniform
/// pupil that makes
///
///     <x_i x_j x_k> = |S|² (S_i δ_jk + S_j δ_ik + S_k δ_ij) / 12,   S = S₁ (ρ - ρ₀).
///
/// The centroid's displacement by coma, S itself, is linear in ρ, and so part of the camera's focal
/// length and principal point. ρ₀ ≠ 0 after the lens' parts have been decentred.
struct PointSpread {
  double centre_sigma_px;       ///< σ₀
  double corner_sigma_px;       ///< σ₁
  double corner_coma_px = 0.0;  ///< S₁; positive: the tail points outwards.
  Eigen::Vector2d coma_centre = Eigen::Vector2d::Zero();  ///< ρ₀
  cv::Mat1f confusion_px = {};                            ///< c of each pixel; empty: 0.
};

/// σ² of a pixel of an image of this size [px²].
double VarianceAt(const PointSpread& spread, cv::Size size, const Eigen::Vector2d& pixel);

/// Square of the distance from an image's centre to the outer corners of its corner pixels, where
/// ρ = 1 [px²].
double SquaredHalfDiagonal(cv::Size size);

/// The image that pixels integrate behind a lens: the mean over each pixel's area of the image
/// convolved with a point spread. The light must be known by quarters of pixels: blurring whole
/// pixels would displace edges along rows by up to 0.03 px.
///
/// One kernel over the quarters, of a Gaussian and the pixel's square, has the discrete variance
/// σ₀² + 1/16, which with the quarters' own 1/48 is that of the optics and the pixel, σ₀² + 1/12.
/// Three-tap kernels whose discrete variances add up to σ² - σ₀², exactly, at every pixel follow,
/// and -|S|²/24 (S·∇)∇² in central differences, which has the third moments, exactly, and neither
/// mean nor variance. The kernel is not positive: where S reaches a pixel, a black side of an edge
/// may lose a per cent of the step, down to 0. The border is replicated; its two outermost pixels
/// have no coma. Domain: 0 ≤ σ₀ ≤ σ₁ ≤ 20 px; float images of one size and number of channels,
/// which the result has too.
cv::Mat Gather(const QuarterImages& quarters, const PointSpread& spread);

}  // namespace fenestra
