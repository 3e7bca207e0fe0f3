#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vision/frame/side_request.h"
#include "vision/frame/frame_knowledge.h"
#include "vision/frame/frame_rectangle.h"

namespace fenestra {

struct FrameAdjustment {
  FrameRectangle frame;
  /// Of FrameRectangle's parameters in their order; rows of those that were not fitted are zero.
  Eigen::Matrix<double, FrameRectangle::kParameters, FrameRectangle::kParameters> covariance;
  std::vector<std::vector<bool>> is_inlier;  ///< By view, for each point.
  /// Root mean square of the residuals over their standard deviations.
  double scale = 0.0;
};

/// The frame that fits best to edge points in all views: minimises
///
///     Σ ρ(n·(π(X_CL p_LQ) - q) / σ)
///
/// over rotation, centroid, width, height and, if there are points of the inner edge, the border's
/// width; over a relief that has a prior. π: the camera with its distortion; p_LQ: the
/// point of the side at the edge point's share of it; q, n, σ: the edge point. ρ: Tukey's biweight
/// at 4.685 times the residuals' own scale (1.4826 of their median size, at least 1); then least
/// squares over those within 3.5 times that scale. Levenberg and Marquardt, iterated reweighting.
///
/// Measured planes add (m(frame) - m)ᵀ Λ (m(frame) - m), Λ their information, times the square of
/// the residuals' scale: edges that are off by more than their noise count less beside them.
///
/// The covariance is (JᵀWJ)⁻¹ times the inliers' mean square where that is above 1: edges of
/// textured walls are off by more than noise explains. What the points of one side in one view may
/// be off together is carried through to it. nullopt if the points fix no rectangle.
std::optional<FrameAdjustment> AdjustFrame(std::span<const CameraView> views,
                                           const std::vector<std::vector<EdgePoint>>& points,
                                           const FrameRectangle& start,
                                           const FrameKnowledge& knowledge);

}  // namespace fenestra
