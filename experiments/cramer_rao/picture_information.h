#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "core/geometry/camera_model.h"
#include "experiments/cramer_rao/cramer_rao.h"
#include "experiments/cramer_rao/pixel_noise.h"
#include "sim/camera/point_spread.h"

namespace fenestra {

/// Sides of a frame, each with three levels of brightness that are unknown in each picture.
inline constexpr int kSides = 4;
inline constexpr int kLevelsOfPicture = 3 * kSides;

/// One picture of a frame, and where its own unknowns stand among all.
struct ElectronPicture {
  const CameraModel& camera;
  Pose X_VC;                   ///< From the scored camera C to this one.
  const cv::Mat1f& electrons;  ///< Expected in each pixel, without noise.
  PixelNoise noise;
  PointSpread spread;
  int blur_unknown;                        ///< The unknown that is added to σ everywhere.
  int level_unknown;                       ///< The first of kLevelsOfPicture.
  std::optional<int> camera_unknown = {};  ///< First of the 9 of CameraModel::ParameterVector.
  std::optional<int> pose_unknown = {};  ///< First of 6: turn δ, R_VC = exp(δ) R; shift of p_VC.
};

/// Fisher information of a picture's pixels on `unknowns` unknowns, of which the first are those of
/// the frame: lines of pixels across the four sides, every side with levels of its own, as bright
/// as the picture is there. Edges are those that the camera sees, distortion included, straight
/// over a sixteenth of a side. Sides count as if nothing stood before them; what is in front of one
/// counts for how bright it is there. Where two sides meet, each counts as if it were alone.
///
/// If more than 64 lines cross a side, evenly chosen ones count for the others.
///
/// nullopt if the camera does not see all corners.
std::optional<Eigen::MatrixXd> PictureInformation(const FrameState& frame,
                                                  const ElectronPicture& view, int unknowns);

}  // namespace fenestra
