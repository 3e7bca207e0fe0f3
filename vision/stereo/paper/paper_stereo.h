#pragma once

#include "core/detection/detector.h"
#include "core/geometry/calibration.h"
#include "vision/stereo/paper/block_matching.h"
#include "vision/stereo/paper/closed_contour.h"
#include "vision/stereo/paper/frame_hypothesis.h"
#include "vision/stereo/paper/paper_stereo_options.h"
#include "vision/stereo/paper/window_rectangle.h"
#include "vision/stereo/rectification.h"

namespace fenestra {

/// The settings of block matching that follow from the options for a rectified camera whose images
/// are `width_px` wide.
BlockMatchingSettings MatchingSettings(const PaperStereoOptions& options,
                                       const RectifiedCamera& camera, int width_px);

/// The stereo method of S. Zhou, G. Flores, R. Lozano and P. Castillo, "Vision-based window
/// estimation for MAV in unknown urban environments", IFAC RED-UAS 2013, section 3.
///
///   stage         what                                                       where
///   rectify       Bouguet's rectification of both images                     rectification.h
///   match         SAD block matching                                         block_matching.h
///   depth_image   z = f B / d                                                closed_contour.h
///   close_gaps    connected components; one closed contour from two bands    frame_hypothesis.h
///   edges         Canny on the depth image                                   closed_contour.h
///   contour       the closed contour's four sides                            quadrilateral.h
///   centroid      corners on the frame's plane, crossing of the diagonals    window_rectangle.h
///
/// Estimates are in L, the unrectified left camera. Their covariance, given the calibration, is
/// derived from the plane's residuals and two stated errors of block matching
/// (window_rectangle.h). The window with the best score is reported and names the others. Pictures
/// in the log: "rectified", "depth_image", and for the best window "closed_contour" and "edges".
///
/// Departures from the paper, which is brief: contours are closed across the frame's horizontal
/// sides, which block matching cannot see; if the first search finds no frame, a second one is made
/// near its result; and corners are moved inwards by the amount that the SAD block fattens the
/// contour. The last two are options.
class PaperStereoDetector : public Detector {
 public:
  /// Throws InputError for options that Validate refuses and for a calibration that cannot be
  /// rectified, see StereoRectification.
  PaperStereoDetector(const StereoCalibration& calibration, const PaperStereoOptions& options);

  SensorKind sensor() const override { return SensorKind::kStereo; }

  /// Miss: "no_matches", "no_component_pair", "no_contour", "not_a_quadrilateral",
  /// "implausible_shape"; "unexpected_size", "unexpected_shape", "unexpected_grey" with a prior.
  Detection Detect(const Observation& observation, StageLog& log) const override;

 private:
  /// Disparities and the patches that they form.
  struct Matches {
    cv::Mat1f disparity;
    std::vector<MatchedPatch> patches;
  };
  using Frames = std::variant<std::vector<FrameHypothesis>, Miss>;

  Matches Match(const RectifiedPair& pair) const;
  /// Returns nullopt if that changes nothing.
  std::optional<Matches> MatchAgain(const RectifiedPair& pair, const Matches& matches) const;
  /// The frames refer to the matches.
  Frames FindFramesIn(const Matches& matches) const;
  /// Runs the stages from close_gaps on.
  Detection FindWindows(const RectifiedPair& pair, const Matches& matches,
                        const std::vector<FrameHypothesis>& frames, StageLog& log) const;
  /// Runs the stages from edges on for one frame.
  Detection MeasureFrame(const RectifiedPair& pair, const FrameHypothesis& frame,
                         const DepthPatch& closed, StageLog& log, bool with_pictures) const;
  std::optional<Quadrilateral> FindCorners(const std::vector<cv::Point>& contour) const;
  WindowEstimate WithCovariance(const WindowEstimate& estimate_F,
                                const FrameHypothesis& frame) const;

  PaperStereoOptions options_;
  StereoRectification rectification_;
  BlockMatchingSettings matching_;
  PatchSettings patches_;
  FrameCriteria criteria_;
  DepthRange range_;
  MatchErrors errors_;
};

}  // namespace fenestra
