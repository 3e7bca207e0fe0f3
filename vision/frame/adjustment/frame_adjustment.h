#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vision/frame/measurement/edge_points.h"
#include "vision/frame/model/frame_prior.h"
#include "vision/frame/model/frame_rectangle.h"

namespace fenestra {

struct FrameAdjustment {
  FrameRectangle frame;
  /// Covariance of FrameRectangle's parameters in their order. Rows of parameters that were not
  /// fitted are zero.
  Eigen::Matrix<double, FrameRectangle::kParameters, FrameRectangle::kParameters> covariance;
  std::vector<std::vector<bool>> is_inlier;  ///< For each point of each view.
  /// Root mean square of the residuals, each divided by its standard deviation.
  double scale = 0.0;
};

/// Fits a frame to the edge points of all views by minimising
///
///     Σ ρ(n·(π(X_CL p_LQ) - q) / σ)
///
/// over rotation, centroid, width and height; over the border's width if there are points of the
/// inner edge; and over each relief that has a prior. π is the camera with its distortion, p_LQ the
/// point on the side at the edge point's share of it, and q, n and σ describe the edge point. ρ is
/// Tukey's biweight at 4.685 times the scale of the residuals (1.4826 times their median absolute
/// value, at least 1), followed by least squares over the residuals within 3.5 times that scale.
/// The solver is Levenberg–Marquardt with iterated reweighting.
///
/// Each measured plane adds (m(frame) - m)ᵀ Λ (m(frame) - m), with Λ its information, times the
/// square of the residuals' scale: where edges are off by more than their noise, the planes weigh
/// more against them.
///
/// The covariance is (JᵀWJ)⁻¹, times the mean square of the inliers where that exceeds 1, since the
/// edges of textured walls are off by more than noise explains. Errors that the points of one side
/// in one view share are propagated to it. Returns nullopt if the points do not determine a
/// rectangle.
std::optional<FrameAdjustment> AdjustFrame(std::span<const CameraView> views,
                                           const std::vector<std::vector<EdgePoint>>& points,
                                           const FrameRectangle& start, const FramePrior& prior);

}  // namespace fenestra
