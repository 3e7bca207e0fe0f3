#include "sim/structured_light/disparity_range.h"

#include <cmath>

namespace fenestra {

DisparityRange DisparityRange::Of(double focal_px, int width_px, double baseline_m, double step_px,
                                  bool near_mode) {
  return {.focal_times_baseline = focal_px * baseline_m * kImageWidth / width_px,
          .step_px = step_px,
          .nearest_m = near_mode ? 0.4 : 0.8,
          .farthest_m = near_mode ? 3.0 : 4.0};
}

double DisparityRange::Depth(double disparity_px) const {
  const double quantised_px =
      step_px > 0.0 ? step_px * std::round(disparity_px / step_px) : disparity_px;
  const double z_m = focal_times_baseline / quantised_px;
  return Contains(z_m) ? z_m : 0.0;
}

}  // namespace fenestra
