#pragma once

#include <Eigen/Core>
#include <numbers>

#include "core/camera_model.h"
#include "sim/depth_frame.h"
#include "sim/disparity_range.h"
#include "sim/infrared_image.h"

namespace fenestra {

/// The parametric model of matching.
struct ParametricMatchingOptions {
  /// Before quantisation, in pixels of a 640-wide image. Khoshelham's σ_z = 1.425e-3 z² is 0.061 px
  /// at f b = 42.8 px m and includes the step's 0.125/√12 = 0.036 px: √(0.061² − 0.036²) = 0.049.
  double disparity_noise_px = 0.049;
  /// Side of the window that is matched (ROS kinect_calibration/technical: 9 x 9 or 9 x 7): pixels
  /// that share a window share its noise.
  int window_px = 9;
  /// Lateral jitter of each depth pixel, in the same pixels (Barron & Handa, simkinect: 0.5).
  double lateral_noise_px = 0.5;
  /// A 9 x 9 window holds 9 dots: its evidence is √9 times a dot's. Matched when it exceeds this.
  double least_snr = 3.5;
  double grazing_limit_rad =
      75.0 * std::numbers::pi / 180.0;  ///< Between the 70° and 80° that users report.
};

/// Throws InputError with all faults.
void Validate(const ParametricMatchingOptions& options);

/// What one pixel of the depth camera sees, in that camera's frame.
struct LitSurface {
  double z_m;                ///< NaN: nothing.
  Eigen::Vector3d normal_C;  ///< Facing the camera.
  bool sees_projector;
  InfraredLight light;
};

struct DepthReading {
  NoReturn no_return = NoReturn::kNone;
  double z_m = 0.0;  ///< 0 without a return.
};

/// Whether the projector's dots are recognised at a pixel, and at which depth.
///
/// With the dots' signal s, ambient light a and noise σ of InfraredOptions, clipped at saturation,
/// a window of nine dots is matched if 3 s/σ plus its noise exceeds least_snr. Its disparity is
///
///     d = f b / z + σ_d n,  rounded to the step,  and  z' = f b / d.
class DotMatching {
 public:
  /// Keeps references to the options.
  DotMatching(const ParametricMatchingOptions& options, const InfraredOptions& infrared,
              const DisparityRange& range);

  /// `ray`: of the pixel, with z = 1. The noises are standard normal variates of the window's
  /// evidence and of its disparity.
  DepthReading Read(const LitSurface& surface, const Eigen::Vector3d& ray, double evidence_noise,
                    double disparity_noise) const;

 private:
  NoReturn Evidence(const InfraredLight& light, double noise) const;

  const ParametricMatchingOptions& options_;
  const InfraredOptions& infrared_;
  DisparityRange range_;
};

}  // namespace fenestra
