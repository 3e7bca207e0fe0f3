#pragma once

#include "core/detection/detector.h"
#include "core/geometry/calibration.h"
#include "vision/frame/frame_fitter.h"
#include "vision/rgbd/plane/depth_points.h"
#include "vision/rgbd/plane/plane_rgbd_options.h"
#include "vision/rgbd/plane/plane_seed.h"

namespace fenestra {

/// Detects a dark-framed window by its edges in the colour image and by the plane of the
/// surrounding wall in the depth image, and fits one rectangle to both.
///
///   stage      what                                                  where
///   read       colour as light, depth as rays with inverse depths    rgbd_images, depth_points
///   segments   straight edges, grouped by the side that they may be  edge_segments
///   propose    dark quadrilaterals                                   dark_quadrilateral
///   plane      those that are rectangles on the plane around them    plane_seed
///   fit        edges to sub-pixel in the colour image as delivered,  frame_fitter,
///              planes of wall and frame with their covariance,       depth_plane, frame_planes
///              one rectangle with a border fitted to all of them
///   choose     the clearest, which names the others                  frame_score
///
/// The edges determine the rectangle's direction and shape to hundredths of a pixel, but not its
/// scale; the depth determines the scale and, less precisely, the tilt. A black frame returns
/// little light to the depth sensor, so the plane is that of the surrounding wall. The offset
/// between wall and front is an option; where the frame does return depth that contradicts it, the
/// offset is estimated.
///
/// Estimates are in D, the camera that the depth image belongs to. Their covariance is that of the
/// fit: it covers the noise of both images, given the calibration and the offset. Pictures in the
/// log: "segments", "edge_points", "depth_use".
class PlaneRgbdDetector : public Detector {
 public:
  /// Throws InputError for options that Validate refuses and for a depth unit that is not positive.
  PlaneRgbdDetector(const RgbdCalibration& calibration, const PlaneRgbdOptions& options);

  SensorKind sensor() const override { return SensorKind::kRgbd; }

  /// Miss: "no_quadrilateral", "no_depth", "not_a_rectangle", "no_edges", "unsupported_side",
  /// "implausible_shape", "not_dark", "open_border", "stands_before", "unexpected_setback",
  /// "uneven_border", depending on how far the best candidate got; "unexpected_size",
  /// "unexpected_shape" or "unexpected_color" with a prior.
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
  /// The data of one observation that the fit needs.
  struct Scene {
    const RgbdObservation& images;
    const CameraView& view;
    const std::vector<DepthPoint>& points;
  };
  Detection FitBest(const Scene& scene, const std::vector<PlaneSeed>& seeds, StageLog& log) const;
  std::variant<Finished, Miss> Finish(const Scene& scene, Candidate& candidate) const;
  std::optional<Miss> Objection(const Scene& scene, const FrameRectangle& fitted) const;

  PlaneRgbdOptions options_;
  RgbdCalibration calibration_;
  CameraModel pinhole_;     ///< The colour camera without its distortion.
  cv::Mat2f undistortion_;  ///< Empty without distortion.
  DepthPointReader reader_;
  DarknessSettings darkness_;
  FrameFitSettings fitting_;
  DepthNoise noise_;
  FrameLimits limits_;
  double clear_px_;  ///< Depth pixels nearer to an edge than this are left out.
};

}  // namespace fenestra
