#include "vision/frame/frame_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

// A window whose size differs by this share from what is expected is another one.
constexpr double kUnexpected = 0.08;

}  // namespace

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

std::optional<Miss> ObjectionToSize(const FrameRectangle& frame,
                                    const std::optional<SizePrior>& expected) {
  if (!expected) return std::nullopt;
  const double tolerance_m = std::max(kUnexpected * std::min(expected->width_m, expected->height_m),
                                      5.0 * expected->sigma_m);
  if (std::abs(frame.width_m - expected->width_m) <= tolerance_m &&
      std::abs(frame.height_m - expected->height_m) <= tolerance_m) {
    return std::nullopt;
  }
  return Miss{"unexpected_size",
              fmt::format("{:.2f} x {:.2f} m instead of {:.2f} x {:.2f} m", frame.width_m,
                          frame.height_m, expected->width_m, expected->height_m)};
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
