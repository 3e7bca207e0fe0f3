#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vision/frame/side_request.h"
#include "vision/frame/frame_knowledge.h"

namespace fenestra {

/// By view.
using EdgePointsByView = std::vector<std::vector<EdgePoint>>;

/// n·(π(X_CL p_LQ) - q)/σ of all points, view by view (see frame_adjustment.h). nullopt where one
/// is behind a camera.
std::optional<std::vector<double>> EdgeResiduals(std::span<const CameraView> views,
                                                 const EdgePointsByView& points,
                                                 const FrameRectangle& frame);

/// 1.4826 times their median size, at least 1.
double RobustScale(std::vector<double> residuals);

/// What a residual costs: Tukey's biweight at 4.685 times the scale, or its square up to 3.5 times.
struct EdgeLoss {
  double scale;
  bool square;

  double Weight(double residual) const;
  double Of(const std::vector<double>& residuals) const;
};

NormalEquations LineariseEdges(std::span<const CameraView> views, const EdgePointsByView& points,
                               const FrameRectangle& frame, const EdgeLoss& loss);

/// Σ σ_g² v_g v_gᵀ over the sides and borders in all views: what errors that all points of one have
/// in common make of the gradient, v = Σ w j/σ.
Eigen::Matrix<double, FrameRectangle::kParameters, FrameRectangle::kParameters> CommonErrors(
    std::span<const CameraView> views, const EdgePointsByView& points, const FrameRectangle& frame,
    const EdgeLoss& loss);

}  // namespace fenestra
