#pragma once

#include <optional>
#include <vector>

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

/// A plane parallel to the frame's front that was measured without looking at the frame's edges, as
/// depth does: { p : m·p = 1 }, in L, with m = n/(n·p_LO + relief) for a frame of normal n.
struct PlaneMeasurement {
  Eigen::Vector3d m;            ///< [1/m]
  Eigen::Matrix3d information;  ///< Of m; inverse of its covariance, or of less rank [m²].
  double relief_m = 0.0;        ///< Of the plane before (+) or behind the frame's front.
};

/// What is assumed of a frame. Sides without a relief are in its plane.
struct FrameKnowledge {
  std::optional<SizePrior> size;
  std::optional<ReliefPrior> outer_relief;
  std::optional<ReliefPrior> inner_relief;
  std::vector<PlaneMeasurement> planes{};
};

/// Of a least-squares problem in FrameRectangle's parameters: JᵀWJ and -JᵀWr.
struct NormalEquations {
  Eigen::Matrix<double, FrameRectangle::kParameters, FrameRectangle::kParameters> matrix;
  FrameRectangle::Step gradient;

  NormalEquations() {
    matrix.setZero();
    gradient.setZero();
  }
};

/// Adds what is known. `plane_weight`: by how much residuals of edges are larger than their
/// standard deviations, squared.
void AddKnowledge(const FrameRectangle& frame, const FrameKnowledge& knowledge, double plane_weight,
                  NormalEquations& equations);

/// Sum of the squares whose half AddKnowledge's gradient is the descent of.
double LossOfKnowledge(const FrameRectangle& frame, const FrameKnowledge& knowledge,
                       double plane_weight);

}  // namespace fenestra
