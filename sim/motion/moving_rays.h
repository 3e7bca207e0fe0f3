#pragma once

#include <vector>

#include "renderers/ray_caster.h"
#include "renderers/tracing/ray_grid.h"
#include "sim/motion/rolling_shutter.h"

namespace fenestra {

/// The rays of a camera at a rig's frame B, with a rolling shutter. The exposure is assumed to be
/// short.
class MovingRays {
 public:
  MovingRays(const CameraModel& camera, const RollingShutter& shutter);

  const CameraModel& camera() const { return camera_; }
  const std::vector<RowBand>& row_bands() const { return row_bands_; }
  /// Pose of the camera while it exposes this band; X_WB: pose in the middle of the image.
  Pose PoseIn(const RowBand& band, const Pose& X_WB) const {
    return PoseAt(X_WB, motion_, band.t_s);
  }

  /// Truths along one ray through each pixel's centre, from the camera's pose during its row. p_BP:
  /// the point whose view of the surfaces is tested; it moves with the rig.
  AovImages CastAovs(const RayCaster& caster, const Pose& X_WB, const Lighting& lighting,
                     const Eigen::Vector3d& p_BP) const;

 private:
  RigMotion motion_;
  CameraModel camera_;
  std::vector<RowBand> row_bands_;
  std::vector<RayGrid> rays_;  ///< The rays of each band.
};

}  // namespace fenestra
