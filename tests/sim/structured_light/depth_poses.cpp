#include "tests/sim/structured_light/depth_poses.h"

#include <cmath>

#include "scenes/facade/facade.h"

namespace fenestra::testing {

int64_t DepthPixelsWhereNothingIs(DepthModel model, int poses, uint64_t seed) {
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
  int64_t wrong = 0;
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
    for (int v = 0; v < frame.depth.raw.rows; ++v) {
      for (int u = 0; u < frame.depth.raw.cols; ++u) {
        const bool is_return = frame.depth.raw(v, u) != 0;
        if (is_return != (frame.no_return(v, u) == 0)) ++wrong;
        // The parametric model jitters its rays: only a neighbourhood without surface counts.
        bool is_surface = false;
        for (int y = std::max(v - 1, 0); y <= std::min(v + 1, truth_m.rows - 1); ++y) {
          for (int x = std::max(u - 1, 0); x <= std::min(u + 1, truth_m.cols - 1); ++x) {
            is_surface |= std::isfinite(truth_m(y, x));
          }
        }
        if (is_return && !is_surface) ++wrong;
      }
    }
  }
  return wrong;
}

}  // namespace fenestra::testing
