#include "sim/structured_light/disparity.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

// The vertex of the parabola through the logarithms at -1/2, 0 and 1/2 px.
float VertexOfLogarithms(float before, float score, float after) {
  const float left = std::log(before / score);
  const float right = std::log(after / score);
  const float bend = left + right;
  return bend < 0.0f ? 0.25f * (left - right) / bend : 0.0f;
}

}  // namespace

DisparityRange DisparityRange::Of(double focal_px, int width_px, double baseline_m,
                                  DepthDriver driver, bool near_mode) {
  const double fb = focal_px * baseline_m * kImageWidth / width_px;
  if (driver == DepthDriver::kOpenNi) {
    return {.focal_times_baseline = fb, .step_px = 0.125, .nearest_m = 0.5, .farthest_m = 9.0};
  }
  return {.focal_times_baseline = fb,
          .step_px = 0.0625,
          .nearest_m = near_mode ? 0.4 : 0.8,
          .farthest_m = near_mode ? 3.0 : 4.0};
}

double DisparityRange::Depth(double disparity_px) const {
  const double quantised_px =
      step_px > 0.0 ? step_px * std::round(disparity_px / step_px) : disparity_px;
  const double z_m = focal_times_baseline / quantised_px;
  return Contains(z_m) ? z_m : 0.0;
}

SubpixelVertex::SubpixelVertex(const SampledPattern& pattern) {
  const auto fill = [&](Curve& curve, double step) {
    for (int i = 0; i < kOffsets; ++i) {
      const double place = step + i * static_cast<double>(kSpacing);
      const auto at = [&](double offset) {
        return static_cast<float>(pattern.Correlation(place, step + offset));
      };
      curve[static_cast<size_t>(i)] = VertexOfLogarithms(at(-0.5), at(0.0), at(0.5));
    }
  };
  fill(at_whole_, 0.0);
  fill(at_half_, 0.5);
}

float SubpixelVertex::Offset(bool is_whole_pixel, float before, float score, float after) const {
  if (before <= 0.0f || after <= 0.0f) return 0.0f;
  const float raw = VertexOfLogarithms(before, score, after);
  const Curve& curve = is_whole_pixel ? at_whole_ : at_half_;
  const float size = std::min(std::abs(raw), curve.back());
  const auto above = std::upper_bound(curve.begin() + 1, curve.end() - 1, size);
  const auto below = above - 1;
  const float fraction = (size - *below) / (*above - *below);
  return std::copysign(kSpacing * (static_cast<float>(below - curve.begin()) + fraction), raw);
}

}  // namespace fenestra
