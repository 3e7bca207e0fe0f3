#pragma once

#include "core/detection/detector.h"
#include "core/geometry/calibration.h"
#include "vision/rgbd/paper/cloud_shape.h"
#include "vision/rgbd/paper/dark_cloud.h"
#include "vision/rgbd/paper/depth_registration.h"
#include "vision/rgbd/paper/diagonals.h"
#include "vision/rgbd/paper/paper_rgbd_options.h"

namespace fenestra {

/// Parameters of the processing that follow from the options: the tolerance of a point's distance
/// from the plane, the stride of the range image's pixels, and NARF's support size [m] for a cloud
/// as the working camera sees it.
PlaneTolerance ToleranceOf(const PaperRgbdOptions& options);
int RangeImageStride(const CameraModel& camera, const PaperRgbdOptions& options);
double SupportSize(const CloudShape& shape, const CameraModel& camera,
                   const PaperRgbdOptions& options);

/// The RGB-D pipeline of S. Zhou, G. Flores, R. Lozano, P. Castillo, "Vision-based window
/// estimation for MAV in unknown urban environments", IFAC RED-UAS 2013, section 4. Its stages:
///
///     register     depth to the colour camera's viewpoint (not specified in the paper)
///     segment      Algorithm 1: dark pixels with depth become a cloud
///     range_image  Algorithm 2: the cloud's range image; its plane and size
///     narf         Algorithm 2: NARF key points
///     vertices     the largest quadrilateral of key points on the cloud's plane (likewise)
///     centroid     the intersection of the diagonals
///
/// The vertices are the key points themselves. NARF places them on stable surface *inside* the
/// frame's corners, so p_CV lies a few per cent of the side inside the true outline. It does so
/// equally on opposite sides, which cancels in the centroid to first order. The normal is that of
/// the plane, and the covariance is that of diagonals.h. The score is the product of the
/// quadrilateral's share of the cloud's hull, the share of the cloud on its plane, the seen share
/// of the least seen side, and the free share of the middle.
///
/// Misses: no_dark_pixels, no_depth_on_dark_pixels, cloud_too_small, no_plane, too_few_key_points,
/// not_a_quadrilateral, implausible_shape; not_open with max_filled_share, no_frame with
/// min_seen_share; unexpected_size and unexpected_shape with a prior.
class PaperRgbdDetector : public Detector {
 public:
  /// Throws InputError for options out of range, a depth unit that is not positive, or a colour
  /// camera with a horizontal field of 90° or more, which PCL's planar range image cannot hold.
  PaperRgbdDetector(const RgbdCalibration& calibration, const PaperRgbdOptions& options);

  SensorKind sensor() const override { return SensorKind::kRgbd; }
  Detection Detect(const Observation& observation, StageLog& log) const override;

 private:
  DarkCloud Segment(const RegisteredImages& registered) const;
  /// The clouds that are searched one after the other.
  std::vector<DarkCloud> Split(const DarkCloud& cloud) const;
  Detection FindFrame(const DarkCloud& cloud, StageLog& log, bool with_pictures) const;
  Detection Estimate(const DarkCloud& cloud, const CloudShape& shape, const FourVertices& p_KV,
                     double area_fraction, double support_m) const;

  RgbdCalibration calibration_;
  PaperRgbdOptions options_;
  DepthRegistration registration_;
};

}  // namespace fenestra
