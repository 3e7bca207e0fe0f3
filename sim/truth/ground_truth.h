#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"
#include "renderers/tracing/render_types.h"
#include "scenes/scene.h"

namespace fenestra {

/// The true pose and size of a window before the scored camera C.
struct WindowTruth {
  Eigen::Vector3d p_CO;
  std::array<Eigen::Vector3d, 4> p_CV;  ///< Top left, top right, bottom right, bottom left.
  Eigen::Vector3d normal_C;             ///< Points out of the wall.
  double width_m;
  double height_m;
};

/// The truth of one observation. C is the true, unrectified left camera (stereo) or the true
/// camera that the depth image's pixels belong to (RGB-D).
struct GroundTruth {
  Pose X_WC;
  std::optional<WindowTruth> target;
  std::vector<WindowTruth> other_windows;
  /// Whether the target's front outer rectangle is seen from its front and lies wholly inside
  /// every image of the observation. False without a target.
  bool in_view = false;
};

WindowTruth TruthOf(const TargetWindow& window, const Pose& X_WC);

/// A camera with its true pose.
struct PlacedCamera {
  CameraModel camera;
  Pose X_WC;
};

/// The truth for the scored camera at X_WC. `cameras` are all cameras that must see the target.
GroundTruth MakeGroundTruth(const Scene& scene, const Pose& X_WC,
                            std::span<const PlacedCamera> cameras);

/// Per-pixel truth of the scored camera C of one observation: the true left camera (stereo) or the
/// depth camera (RGB-D).
struct TruthImages {
  CameraModel camera;
  Pose X_WC;
  /// `sees_point` is the view of the right camera (stereo) or of the projector (RGB-D).
  AovImages aovs;
  Band band;           ///< The quantity of `radiance`.
  cv::Mat1f radiance;  ///< Before lens and sensor; see Band.
  /// The true disparity [px], for matchers: (u_L − u_R, v_L − v_R) of the surface point between the
  /// true, unrectified cameras (stereo), or f b / z between infra-red camera and projector (RGB-D).
  /// NaN where nothing is hit or the point projects outside the right image.
  cv::Mat2f disparity_px;
};

}  // namespace fenestra
