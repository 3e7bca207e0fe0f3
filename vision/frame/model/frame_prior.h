#pragma once

#include <optional>
#include <vector>

#include "vision/frame/model/frame_rectangle.h"

namespace fenestra {

/// Prior knowledge of a frame's size.
struct SizePrior {
  double width_m;
  double height_m;
  double sigma_m;
};

/// Prior knowledge of how far sides are from the frame's plane.
struct ReliefPrior {
  double mean_m;
  double sigma_m;
};

/// A plane parallel to the frame's front that was measured independently of the frame's edges, for
/// example in a depth image: { p : m·p = 1 } in L, with m = n/(n·p_LO + relief) for a frame with
/// normal n.
struct PlaneMeasurement {
  Eigen::Vector3d m;            ///< [1/m]
  Eigen::Matrix3d information;  ///< Inverse covariance of m; it may be rank deficient [m²].
  double relief_m = 0.0;        ///< The plane lies this far in front of (+) the frame's front.
};

/// Prior knowledge that enters a fit, including measured planes. Sides without a relief prior lie
/// in the frame's plane.
struct FramePrior {
  std::optional<SizePrior> size;
  std::optional<ReliefPrior> outer_relief;
  std::optional<ReliefPrior> inner_relief;
  std::vector<PlaneMeasurement> planes{};
};

/// Normal equations of a least-squares problem in FrameRectangle's parameters: JᵀWJ and -JᵀWr.
struct NormalEquations {
  Eigen::Matrix<double, FrameRectangle::kParameters, FrameRectangle::kParameters> matrix;
  FrameRectangle::Step gradient;

  NormalEquations() {
    matrix.setZero();
    gradient.setZero();
  }
};

/// Adds the prior knowledge to the normal equations. `plane_weight` is the squared ratio of the
/// edges' residuals to their standard deviations.
void AddPrior(const FrameRectangle& frame, const FramePrior& prior, double plane_weight,
              NormalEquations& equations);

/// Sum of squares of the prior terms; AddPrior adds the negative gradient of half of it.
double LossOfPrior(const FrameRectangle& frame, const FramePrior& prior, double plane_weight);

}  // namespace fenestra
