#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vision/frame/measurement/edge_points.h"
#include "vision/frame/model/frame_prior.h"

namespace fenestra {

/// Edge points of each view.
using EdgePointsByView = std::vector<std::vector<EdgePoint>>;

/// Residuals n·(π(X_CL p_LQ) - q)/σ of all points, view by view (see frame_adjustment.h). Returns
/// nullopt if a point is behind a camera.
std::optional<std::vector<double>> EdgeResiduals(std::span<const CameraView> views,
                                                 const EdgePointsByView& points,
                                                 const FrameRectangle& frame);

/// 1.4826 times the median absolute residual, at least 1.
double RobustScale(std::vector<double> residuals);

/// Loss of a residual: Tukey's biweight at 4.685 times the scale, or the square, cut off at 3.5
/// times the scale.
struct EdgeLoss {
  double scale;
  bool square;

  double Weight(double residual) const;
  double Of(const std::vector<double>& residuals) const;
};

NormalEquations LineariseEdges(std::span<const CameraView> views, const EdgePointsByView& points,
                               const FrameRectangle& frame, const EdgeLoss& loss);

/// Covariance of the gradient caused by errors that points share. Of those that all points of a
/// side share: Σ σ_g² v_g v_gᵀ over the sides and borders in all views, with v = Σ w j/σ. Of
/// displacements (EdgeShift), with c the correlation between the middles of two sides in one view:
///
///     Σ_g Σ_h c(ρ_g, ρ_h) (u_gx u_hxᵀ + u_gy u_hyᵀ),   u = Σ w σ_d n j/σ.
Eigen::Matrix<double, FrameRectangle::kParameters, FrameRectangle::kParameters> CommonErrors(
    std::span<const CameraView> views, const EdgePointsByView& points, const FrameRectangle& frame,
    const EdgeLoss& loss);

}  // namespace fenestra
