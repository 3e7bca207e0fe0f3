#pragma once

#include <Eigen/Core>

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "experiments/cramer_rao/cramer_rao.h"
#include "renderers/ray_caster.h"
#include "sim/structured_light/sensor_unit.h"
#include "sim/structured_light/structured_light_sensor.h"

namespace fenestra {

/// Unknowns that depth tells of: the frame's; how far the wall's face stands before the front of
/// the frame, besides what is expected [m]; the parameters of the unit (UnitCovariance).
inline constexpr int kWallUnknown = kFrameUnknowns;
inline constexpr int kUnitUnknown = kWallUnknown + 1;
inline constexpr int kDepthUnknowns = kUnitUnknown + kUnitParameters;
using DepthMatrix = Eigen::Matrix<double, kDepthUnknowns, kDepthUnknowns>;

/// The information of depth images on the plane of a frame, by the noise of
/// sim/structured_light/parametric_depth (which was fitted to the speckle model, for which this
/// stands as well). A pixel of a plane n·p = δ has the disparity
///
///     d = (1 + s) f b (n·r)/δ + c + w + noise   [px of a 640-wide image],
///
/// r its ray, by the depth camera as it is; s, c and w are the unit's (DisparityError). Its noise
/// is white noise averaged over the block of N pixels that is matched: neighbours share it, so that
/// over areas wider than a block, M pixels are worth M/N. With fixed and temporal deviation σ_f,
/// σ_t, quantisation step q and k frames averaged, the spectral density at frequency 0, which is
/// what counts for a plane, is
///
///     S = N (σ_f² + (σ_s² + σ_t²)/k) + (q² + u²)/12k + S_w,
///
/// S_w: density of w, which counts as noise for areas much wider than it is correlated; σ_s: of the
/// speckle's flicker, σ_t ~ √(noise of the infra-red image)/dot,
///
/// u: a unit of the depth image as disparity. Steps count as independent noise: they are dithered
/// by a plane's slope and by noise. F = Σ ∂d ∂dᵀ/S over the pixels that return the front of the
/// frame or a face parallel to it at the wall's height. Places of outlines in the depth image are
/// left out: colour tells them a thousand times better.
class DepthTheory {
 public:
  explicit DepthTheory(const StructuredLightSensor& sensor);

  /// wall_m: the wall's face before the front of the frame. C is the camera of the depth image's
  /// pixels. Where the depth image has no return nothing is told. Pixels are judged by every fourth
  /// one of every fourth row.
  DepthMatrix Information(const FrameState& frame, double wall_m, const DepthImage& observed,
                          const RayCaster& caster, const Lighting& lighting,
                          const Pose& X_WB) const;

  /// S of a pixel that gets this light from a surface at this depth [px²].
  double NoiseDensity(const InfraredLight& light, double z_m) const;

 private:
  StructuredLightOptions options_;
  RgbdCalibration cameras_;   ///< Those of the unit; see SensorUnit.
  CameraModel image_camera_;  ///< The depth image's.
  RayGrid rays_;              ///< The infra-red camera's, but coarser.
  double block_px_;           ///< N, in depth pixels.
  double warp_density_;       ///< S_w
  InfraredResponse response_;
  DisparityRange range_;
};

}  // namespace fenestra
