#pragma once

#include "core/calibration.h"
#include "core/detector.h"
#include "vision/frame/frame_fitter.h"
#include "vision/rgbd/depth_points.h"
#include "vision/rgbd/plane_rgbd_options.h"
#include "vision/rgbd/plane_seed.h"

namespace fenestra {

/// A dark-framed window by its edges in the colour image and the plane of the wall around it in the
/// depth image, as one rectangle fitted to both.
///
///   stage      what                                                       where
///   read       colour as light, depth as rays with inverse depths         linear_grey,
///   depth_points segments   straight edges, by the side of something dark
///   vision/frame/edge_segments propose    dark quadrilaterals vision/frame/dark_quadrilateral
///   plane      those that are rectangles on the plane around them         plane_seed
///   fit        edges to sub-pixel in the colour image as delivered,       vision/frame/frame_fitter,
///              the planes of wall and frame with their covariance,        depth_plane, frame_depth
///              one rectangle with a border fitted to all of them
///   choose     the clearest; the others go with it
///
/// Edges know the rectangle's direction and shape to hundredths of a pixel, but nothing of its
/// scale; depth knows the scale and, less well, the tilt. A black frame returns little light to the
/// depth sensor, so the plane is that of the wall around it, before or behind which the frame's
/// front lies by an offset that is an option; where the frame does return depth and that says
/// otherwise, the offset is estimated.
///
/// Estimates are in D, the camera that the depth image belongs to, with the fit's covariance: what
/// noise in both images makes of it, given the calibration and the offset.
/// Pictures in the log: "segments", "edge_points", "depth_use".
class PlaneRgbdDetector : public Detector {
 public:
  /// Throws InputError for options that Validate refuses and for a depth unit that is not positive.
  PlaneRgbdDetector(const RgbdCalibration& calibration, const PlaneRgbdOptions& options);

  SensorKind sensor() const override { return SensorKind::kRgbd; }

  /// Miss: "no_quadrilateral", "no_depth", "not_a_rectangle", "no_edges", "unsupported_side",
  /// "implausible_shape", "not_dark", "open_border", "stands_before", "unexpected_setback",
  /// "uneven_border", by how far the best candidate came; "unexpected_size", "unexpected_shape" or
  /// "unexpected_color" with a prior.
  Detection Detect(const Observation& observation, StageLog& log) const override;

 private:
  struct Candidate {
    PlaneSeed seed;
    FrameFitter fitter;
    FrameFit rough;
    double score;
  };
  struct Finished;
  std::variant<std::vector<PlaneSeed>, Miss> Seeds(const std::vector<DarkQuadrilateral>& candidates,
                                                   const std::vector<DepthPoint>& points) const;
  /// What is seen, as the fit needs it.
  struct Sight {
    const RgbdObservation& images;
    const CameraView& view;
    const std::vector<DepthPoint>& points;
  };
  Detection FitBest(const Sight& sight, const std::vector<PlaneSeed>& seeds, StageLog& log) const;
  std::variant<Finished, Miss> Finish(const Sight& sight, Candidate& candidate) const;
  std::optional<Miss> Objection(const Sight& sight, const FrameRectangle& fitted) const;

  PlaneRgbdOptions options_;
  RgbdCalibration calibration_;
  CameraModel pinhole_;     ///< The colour camera, freed of distortion.
  cv::Mat2f undistortion_;  ///< Empty without distortion.
  DepthPointReader reader_;
  DarknessSettings darkness_;
  FrameFitSettings fitting_;
  DepthNoise noise_;
  FrameLimits limits_;
  double clear_px_;  ///< Depth pixels nearer to an edge than this are left out.
};

}  // namespace fenestra
