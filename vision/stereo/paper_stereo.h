#pragma once

#include "core/calibration.h"
#include "core/detector.h"
#include "vision/stereo/block_matching.h"
#include "vision/stereo/depth_image.h"
#include "vision/stereo/frame_hypothesis.h"
#include "vision/stereo/paper_stereo_options.h"
#include "vision/stereo/rectification.h"

namespace fenestra {

/// The stereo method of S. Zhou, G. Flores, R. Lozano and P. Castillo, "Vision-based window
/// estimation for MAV in unknown urban environments", IFAC RED-UAS 2013, section 3.
///
///   stage         what                                                       where
///   rectify       Bouguet's rectification of both images                     rectification.h
///   match         SAD block matching                                         block_matching.h
///   depth_image   z = f B / d                                                depth_image.h
///   close_gaps    connected components; one closed contour from two bands    frame_hypothesis.h
///   edges         Canny on the depth image                                   closed_contour.h
///   contour       the closed contour's four sides                            quadrilateral.h
///   centroid      corners on the frame's plane, meeting of the diagonals     window_rectangle.h
///
/// Estimates are in L, the unrectified left camera. They carry no covariance: neighbouring matches
/// share their windows and, worse, their sub-pixel bias, so that residuals say little of the
/// plane's error. Pictures in the log: "rectified",
/// "depth_image", "closed_contour", "edges".
///
/// Departures from the paper, which is brief: contours are closed across the frame's horizontal
/// sides, which block matching cannot see; a second search near the first result; corners are
/// moved in by what the SAD window fattens. The last two are options.
class PaperStereoDetector : public Detector {
 public:
  /// Throws InputError for options that Validate refuses and for a calibration that cannot be
  /// rectified, see StereoRectification.
  PaperStereoDetector(const StereoCalibration& calibration, const PaperStereoOptions& options);

  SensorKind sensor() const override { return SensorKind::kStereo; }

  /// Miss: "no_matches", "no_component_pair", "no_contour", "not_a_quadrilateral",
  /// "implausible_shape".
  Detection Detect(const Observation& observation, StageLog& log) const override;

 private:
  cv::Mat1f Match(const RectifiedPair& pair) const;
  /// The stages from close_gaps on.
  Detection FindWindow(const cv::Mat1f& disparity, StageLog& log) const;
  std::optional<Quadrilateral> FindCorners(const std::vector<cv::Point>& contour) const;

  PaperStereoOptions options_;
  StereoRectification rectification_;
  BlockMatchingSettings matching_;
  PatchSettings patches_;
  FrameCriteria criteria_;
  DepthRange range_;
};

}  // namespace fenestra
