#pragma once

#include <vector>

#include "core/geometry/camera_model.h"
#include "sim/motion/rig_motion.h"

namespace fenestra {

/// A camera whose rows are exposed one after the other, on a rig that moves.
struct RollingShutter {
  RigMotion motion;  ///< Of the rig.
  double readout_s =
      0.0;  ///< From the first row's exposure to the last one's; 0: a global shutter.
};

/// Throws InputError unless readout_s is in [0, 1].
void Validate(const RollingShutter& shutter);

/// Consecutive rows of an image, and the middle of their exposures.
struct RowBand {
  int first = 0;
  int count = 0;
  double t_s = 0.0;
};

/// When row v is exposed, the middle of the image at time 0:
///
///     t(v) = readout ((v + 1/2) / height - 1/2).
double RowTime(const RollingShutter& shutter, int height_px, double row);

/// All rows in bands within which the image moves by at most a quarter of a pixel, or of one row;
/// one band if nothing moves. Presumed: nothing is nearer than 0.5 m.
std::vector<RowBand> BandsOf(const RollingShutter& shutter, const CameraModel& camera);

/// Pictures of a camera that moves while its rows are exposed, one after the other, each for
/// exposure_s: taken at equal steps of time, so that the image moves by at most half a pixel from
/// one to the next, or at most 64. Row v is the mean of those whose band it is in. Presumed as
/// above. One picture of all rows if nothing moves.
std::vector<RowBand> PicturesOf(const RollingShutter& shutter, const CameraModel& camera,
                                double exposure_s);

/// The camera that sees these rows alone.
CameraModel RowsOf(const CameraModel& camera, int first, int count);

}  // namespace fenestra
