#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"
#include "core/io/output_path.h"
#include "renderers/exr_io.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// Share of a window's frame that the scored camera sees, in [0, 1]: of points in equal steps along
/// the middle of the frame's front border, those that fall into the image and before which nothing
/// stands. The depth is that of the pixel's centre where the border covers it; points on borders
/// that are too narrow for that are left out, and without any other point the share is 0.
double VisibleShare(const TruthImages& images, const WindowTruth& window, double border_m);

/// {"world_origin_in_file_m": p_FW, "world_from_<camera>": pose, "target_in_view": …, "target":
/// window or null, "other_windows": […]} where a window has its centroid, corners and normal in the
/// camera, and its sizes. What has the position p in the world has p_FW + p in the scene's file.
std::string TruthJson(const GroundTruth& truth, const std::string& camera,
                      const Eigen::Vector3d& p_FW);

/// The cameras of a sensor, the scored one first.
struct NamedCamera {
  std::string name;
  CameraModel camera;
  Pose X_WC;
};

/// TruthJson of a trial whose true cameras are known, with further members:
///
///     camera                      the scored one, in whose frame the windows are: "left", "depth"
///     world_from_<camera>         of every camera
///     world_from_target           the window's frame O: x to the right and y up as seen from
///                                 before the wall, z the normal; absent without a target
///     target_visible_share        see VisibleShare; absent without a target
///     target.corners_px           by camera, where its image has each corner; null behind it
std::string TruthJson(const GroundTruth& truth, std::span<const NamedCamera> cameras,
                      std::optional<double> target_visible_share);

/// Per-pixel truth as named channels of an OpenEXR file:
///
///     Y, or R G B, or infrared.Y    radiance: see Band
///     depth.Z                       along the optical axis [m]; NaN: nothing hit
///     normal.X, normal.Y, normal.Z  geometric, in the camera frame
///     object.ID, material.ID        indices into the scene; -1: nothing hit
///     irradiance.lx, irradiance.830nm
///     reflectance.830nm, transmittance.T
///     sun.V, <point>.V              1 where the sun or the point sees the surface
///     disparity.U, disparity.V      [px]
///
/// with the channels' meaning, the camera's intrinsics and its pose as metadata.
std::vector<ExrChannel> AovChannels(const AovImages& aovs, const std::string& point);

/// CV_32FC1 in one band, or B, G, R.
std::vector<ExrChannel> RadianceChannels(const cv::Mat& radiance, Band band);

std::map<std::string, std::string> CameraMetadata(const CameraModel& camera, const Pose& X_WC);

/// All of it; `point` names what TruthImages::aovs' sees_point is: "right" or "projector".
void WriteTruthExr(const OutputPath& file, const TruthImages& truth, const std::string& point);

}  // namespace fenestra
