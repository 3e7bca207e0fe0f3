#include "tests/sim/structured_light/depth_poses.h"

#include <cmath>

#include "scenes/facade/facade.h"

namespace fenestra::testing {

DepthOfNothing DepthWhereNothingIs(DepthModel model, int poses, uint64_t seed) {
  StructuredLightOptions options;
  options.depth_model = model;
  options.infrared_width_px = 160;
  options.depth_width_px = 80;
  options.depth_height_px = 60;
  options.depth_focal_px /= 4.0;
  const StructuredLightSensor sensor(options);
  const RayCaster caster(MakeFacade({}));
  const RayGrid rays(sensor.nominal().depth);
  Lighting lighting;
  lighting.sky.illuminance_lx = 300.0;
  DepthOfNothing seen;
  for (int i = 0; i < poses; ++i) {
    const RandomStream stream = RandomStream(seed).Child("pose", static_cast<uint64_t>(i));
    const auto uniform = [&](uint64_t k, double low, double high) {
      return low + (high - low) * stream.Uniform(k);
    };
    const double reach_m = std::pow(10.0, uniform(0, -3.0, 2.0));
    const Eigen::Vector3d p_WB(uniform(1, -reach_m, reach_m), uniform(2, -reach_m, reach_m),
                               uniform(3, -0.2 * reach_m, reach_m));
    const Pose X_WB(
        RotationFromVector({uniform(4, -3.0, 3.0), uniform(5, -3.0, 3.0), uniform(6, -3.0, 3.0)}),
        p_WB);
    const ExplainedDepth frame = sensor.ObserveDepth(caster, lighting, X_WB, stream);
    const cv::Mat1f truth_m = caster.CastAovs(rays, X_WB, lighting, {}).depth_m;
    // Blocks of 9 x 9 pixels of the 640 that the sensor matches in are this many of these.
    constexpr int kReach = 3;
    for (int v = 0; v < frame.depth.raw.rows; ++v) {
      for (int u = 0; u < frame.depth.raw.cols; ++u) {
        const bool is_return = frame.depth.raw(v, u) != 0;
        if (is_return != (frame.no_return(v, u) == 0)) ++seen.unexplained;
        const cv::Rect block = cv::Rect(u - kReach, v - kReach, 2 * kReach + 1, 2 * kReach + 1) &
                               cv::Rect({0, 0}, truth_m.size());
        // NaN differs from itself.
        if (cv::countNonZero(truth_m(block) == truth_m(block)) > 0) continue;
        ++seen.pixels;
        if (is_return) ++seen.returns;
      }
    }
  }
  return seen;
}

}  // namespace fenestra::testing
