#pragma once

#include <array>
#include <optional>
#include <vector>

#include "vision/frame/edge_points.h"
#include "vision/frame/frame_rectangle.h"

namespace fenestra {

/// What is known of a frame before it is seen.
struct SizePrior {
  double width_m;
  double height_m;
  double sigma_m;
};

/// How far sides may be from the frame's plane.
struct ReliefPrior {
  double mean_m;
  double sigma_m;
};

/// What is assumed of a frame. Sides without a relief are in its plane.
struct FrameKnowledge {
  std::optional<SizePrior> size;
  std::optional<ReliefPrior> outer_relief;
  std::optional<ReliefPrior> inner_relief;
};

struct FrameAdjustment {
  FrameRectangle frame;
  /// Of FrameRectangle's parameters in their order; rows of those that were not fitted are zero.
  Eigen::Matrix<double, FrameRectangle::kParameters, FrameRectangle::kParameters> covariance;
  std::array<std::vector<bool>, 2> is_inlier;  ///< By view, for each point.
  /// Root mean square of the residuals over their standard deviations.
  double scale = 0.0;
};

/// The frame that fits best to edge points in both views: minimises
///
///     Σ ρ(n·(π(X_CL p_LQ) - q) / σ)
///
/// over rotation, centroid, width, height and, if there are points of the inner edge, the border's
/// width; over a relief that has a prior. π: the camera with its distortion; p_LQ: the
/// point of the side at the edge point's share of it; q, n, σ: the edge point. ρ: Tukey's biweight
/// at 4.685 times the residuals' own scale (1.4826 of their median size, at least 1); then least
/// squares over those within 3.5 times that scale. Levenberg and Marquardt, iterated reweighting.
///
/// The covariance is (JᵀWJ)⁻¹ times the inliers' mean square where that is above 1: edges of
/// textured walls are off by more than noise explains. nullopt if the points fix no rectangle.
std::optional<FrameAdjustment> AdjustFrame(const std::array<CameraView, 2>& views,
                                           const std::array<std::vector<EdgePoint>, 2>& points,
                                           const FrameRectangle& start,
                                           const FrameKnowledge& knowledge);

}  // namespace fenestra
