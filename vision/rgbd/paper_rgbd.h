#pragma once

#include "core/calibration.h"
#include "core/detector.h"
#include "vision/rgbd/cloud_shape.h"
#include "vision/rgbd/dark_cloud.h"
#include "vision/rgbd/depth_registration.h"
#include "vision/rgbd/diagonals.h"
#include "vision/rgbd/dominant_plane.h"
#include "vision/rgbd/paper_rgbd_options.h"

namespace fenestra {

/// What the options make of a cloud as the working camera sees it: how far a point may lie from its
/// plane, of which pixels the range image is made, and NARF's support size [m].
PlaneTolerance ToleranceOf(const PaperRgbdOptions& options);
int RangeImageStride(const CameraModel& camera, const PaperRgbdOptions& options);
double SupportSize(const CloudShape& shape, const CameraModel& camera,
                   const PaperRgbdOptions& options);

/// The RGB-D pipeline of S. Zhou, G. Flores, R. Lozano, P. Castillo, "Vision-based window
/// estimation for MAV in unknown urban environments", IFAC RED-UAS 2013, section 4. Stages:
///
///     register     depth to the colour camera's viewpoint (open in the paper)
///     segment      Algorithm 1: dark pixels with depth become a cloud
///     range_image  Algorithm 2: the cloud's range image; its plane and size
///     narf         Algorithm 2: NARF key points
///     vertices     four of them: the largest quadrilateral on the cloud's plane (open in the
///     paper) centroid     intersection of the diagonals
///
/// The vertices are the key points themselves. NARF places those on stable surface *inside* of the
/// frame's corners, so p_CV lies some per cent of the side inside of the true outline, on either
/// side alike, which leaves the centroid free of it to first order. The normal is that of the
/// plane, the covariance that of crossing_covariance.h. The score is the quadrilateral's share of
/// the cloud's hull, times the cloud's share on its plane, times what is seen of its least
/// seen side, times what of its middle is free.
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
  /// What is searched one after the other.
  std::vector<DarkCloud> Split(const DarkCloud& cloud) const;
  Detection FindFrame(const DarkCloud& cloud, StageLog& log, bool with_pictures) const;
  Detection Estimate(const DarkCloud& cloud, const CloudShape& shape, const FourVertices& p_KV,
                     double area_fraction, double support_m) const;

  RgbdCalibration calibration_;
  PaperRgbdOptions options_;
  DepthRegistration registration_;
};

}  // namespace fenestra
