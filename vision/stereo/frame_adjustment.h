#pragma once

#include <array>
#include <optional>
#include <vector>

#include "vision/stereo/edge_points.h"
#include "vision/stereo/frame_rectangle.h"

namespace fenestra {

/// What is known of a frame before it is seen.
struct SizePrior {
  double width_m;
  double height_m;
  double sigma_m;
};

struct FrameAdjustment {
  FrameRectangle frame;
  /// Of FrameRectangle's parameters in their order; rows of the border are zero where no inner edge
  /// was used.
  Eigen::Matrix<double, FrameRectangle::kParameters, FrameRectangle::kParameters> covariance;
  /// By view: the share of each point's weight that the loss leaves, 0 for an outlier.
  std::array<std::vector<double>, 2> weights;
  /// Root mean square of the residuals over their standard deviations.
  double scale = 0.0;
};

/// The frame that fits best to edge points in both views: minimises
///
///     Σ ρ(n·(π(X_CL p_LQ) - q) / σ)
///
/// over rotation, centroid, width, height and, if there are points of the inner edge, the border's
/// width. π: the camera with its distortion; p_LQ: the point of the side at the edge point's share
/// of it; q, n, σ: the edge point. ρ: Tukey's biweight at 4.685 times the residuals' own scale
/// (1.4826 of their median size, at least 1). Levenberg and Marquardt, by iterated reweighting.
///
/// The covariance is (JᵀWJ)⁻¹ times the residuals' mean square where that is above 1: edges of
/// textured walls are off by more than noise explains. nullopt if the points fix no rectangle.
std::optional<FrameAdjustment> AdjustFrame(const std::array<CameraView, 2>& views,
                                           const std::array<std::vector<EdgePoint>, 2>& points,
                                           const FrameRectangle& start,
                                           const std::optional<SizePrior>& prior);

}  // namespace fenestra
