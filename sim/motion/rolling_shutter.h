#pragma once

#include <vector>

#include "core/geometry/camera_model.h"
#include "renderers/ray_caster.h"
#include "renderers/tracing/ray_grid.h"
#include "sim/motion/rig_pose.h"

namespace fenestra {

/// A camera whose rows are exposed one after the other, on a rig that moves.
struct RollingShutter {
  RigMotion motion;
  /// Time from the first row's exposure to the last one's; 0: a global shutter.
  double readout_s = 0.0;
};

/// Throws InputError unless readout_s is in [0, 1].
void Validate(const RollingShutter& shutter);

/// Consecutive rows of an image, and the middle of their exposures.
struct RowBand {
  int first = 0;
  int count = 0;
  double t_s = 0.0;
};

/// Time at which row v is exposed; the middle of the image is exposed at time 0:
///
///     t(v) = readout ((v + 1/2) / height - 1/2).
double RowTime(const RollingShutter& shutter, int height_px, double row);

/// Divides the rows into bands within which the image moves by at most a quarter of a pixel, or
/// bands of one row if it moves faster; one band if nothing moves. Assumes that nothing is nearer
/// than 0.5 m.
std::vector<RowBand> BandsOf(const RollingShutter& shutter, const CameraModel& camera);

/// Pictures that together make the image of a camera whose rows are exposed for exposure_s each,
/// one after the other, while it moves. They are taken at equal steps of time, between which the
/// image moves by at most half a pixel, unless that needs more than 64. Row v of the image is the
/// mean of the pictures whose bands contain it. Assumes as above that nothing is nearer than 0.5 m.
/// One picture of all rows if nothing moves.
std::vector<RowBand> PicturesOf(const RollingShutter& shutter, const CameraModel& camera,
                                double exposure_s);

/// The camera that sees these rows alone.
CameraModel RowsOf(const CameraModel& camera, int first, int count);

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
