#include "vision/frame/model/frame_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vision/frame/detection/quadrilateral.h"

namespace fenestra {
namespace {

// A window whose size differs from the expected one by more than this share is another window.
constexpr double kUnexpected = 0.08;
constexpr double kMostWarp =
    0.1;  // Distance between the midpoints of the diagonals over the longer side.

}  // namespace

bool AreCornersOfFrame(const std::array<Eigen::Vector3d, 4>& p_CV, const FrameLimits& limits) {
  const WindowShape shape = MeasureShape(p_CV);
  const double shorter = std::min(shape.width_m, shape.height_m);
  const double longer = std::max(shape.width_m, shape.height_m);
  if (shorter < limits.min_side_m || longer > limits.max_side_m) return false;
  if (longer > limits.max_side_ratio * shorter) return false;
  if (shape.skew_rad > limits.max_skew_rad || shape.taper > limits.max_taper) return false;
  const Eigen::Vector3d gap = 0.5 * (p_CV[0] + p_CV[2]) - 0.5 * (p_CV[1] + p_CV[3]);
  return gap.norm() < kMostWarp * longer;
}

std::optional<Miss> ObjectionToFrame(const FrameRectangle& frame, const FrameLimits& limits) {
  const auto implausible = [](const std::string& detail) {
    return Miss{"implausible_shape", detail};
  };
  const double depth_m = frame.p_LO.z();
  if (depth_m < limits.nearest_m || depth_m > limits.farthest_m) {
    return implausible(fmt::format("depth {:.2f} m is out of range", depth_m));
  }
  const double shorter = std::min(frame.width_m, frame.height_m);
  const double longer = std::max(frame.width_m, frame.height_m);
  if (shorter < limits.min_side_m || longer > limits.max_side_m ||
      longer > limits.max_side_ratio * shorter) {
    return implausible(fmt::format("{:.2f} x {:.2f} m", frame.width_m, frame.height_m));
  }
  return std::nullopt;
}

std::optional<Miss> ObjectionToPrior(const FrameRectangle& frame, const WindowPrior& prior) {
  return ObjectionOf(prior, frame.ToEstimate(), kUnexpected);
}

std::optional<SizePrior> SizePriorOf(const WindowPrior& prior) {
  if (!prior.knows_size()) return std::nullopt;
  return SizePrior{.width_m = prior.expected_width_m,
                   .height_m = prior.expected_height_m,
                   .sigma_m = prior.expected_size_sigma_m};
}

}  // namespace fenestra
