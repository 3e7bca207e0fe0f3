#pragma once

#include "core/detection/detector.h"
#include "core/detection/window_prior.h"
#include "core/geometry/calibration.h"
#include "core/io/parameter_table.h"
#include "vision/frame/frame_fitter.h"
#include "vision/frame/frame_search.h"
#include "vision/frame/model/frame_limits.h"
#include "vision/stereo/edge/frame_seed.h"
#include "vision/stereo/rectification.h"

namespace fenestra {

/// Options of edge-stereo, each with the reason for its default.
struct EdgeStereoOptions {
  double rectification_alpha = 1.0;  ///< See PaperStereoOptions.

  FrameSearchOptions search{
      .limits = {.nearest_m = 0.6,     // Where both images of a 4 mm lens see the same 0.5 m.
                 .farthest_m = 15.0},  // Where a 1 m frame is 44 px wide.
      .min_segment_px = 12.0};         // A third of the shortest side that is looked for at 10 m.
  /// Grey value without light: 32 of 1023, the usual pedestal of a sensor's ADC, in 8 bits.
  double black_dn = 8.0;

  /// What edges are off by besides noise, see EdgeShift. Measured (docs/stereo.md) with the
  /// default stereo rig of simulations, and conditional on it: 0.77 px of coma in the corners,
  /// decentred by 0.3 half diagonals, a vehicle that hovers at 5 cm/s and 3°/s, cameras that are
  /// triggered together. More for worse lenses, faster vehicles and cameras that are triggered one
  /// after the other; 0.0004 px for symmetric point spreads and a rig that stands still, where what
  /// is left are blur that varies across an edge and pixels that are not squares.
  EdgeShift edge_shift{.centre_px = 0.003, .corner_px = 0.018};

  /// A known size also enters the fit and improves the depth.
  WindowPrior prior;

  bool operator==(const EdgeStereoOptions&) const = default;
};

/// Throws InputError with all faults.
void Validate(const EdgeStereoOptions& options);

const ParameterTable<EdgeStereoOptions>& EdgeStereoParameters();

/// Detects a dark-framed window by its edges and fits one rectangle to both images.
///
///   stage      what                                                         where
///   rectify    Bouguet's rectification of both images                       rectification.h
///   segments   straight edges of both, grouped by the side that they may be edge_segments.h
///   propose    dark quadrilaterals of the left image                        dark_quadrilateral.h
///   match      their upright sides in the right image: corners in space     frame_seed.h
///   fit        edges to sub-pixel in both images as delivered, one          frame_fitter.h
///              rectangle with a border fitted to all of them
///   choose     the clearest, which names the others                         frame_score.h
///
/// Estimates are in L, the unrectified left camera. Their covariance is that of the fit: it covers
/// the noise of the images and displaced edges (edge_shift) but not errors of the calibration.
/// Pictures in the log: "rectified", "segments", "edge_points".
class EdgeStereoDetector : public Detector {
 public:
  /// Throws InputError for options that Validate refuses and for a calibration that cannot be
  /// rectified, see StereoRectification.
  EdgeStereoDetector(const StereoCalibration& calibration, const EdgeStereoOptions& options);

  SensorKind sensor() const override { return SensorKind::kStereo; }

  /// Miss: "no_quadrilateral", "no_stereo_match", "no_edges", "unsupported_side",
  /// "implausible_shape", "not_dark", "light_frame", depending on how far the best candidate got;
  /// "unexpected_size", "unexpected_shape" or "unexpected_grey" with a prior.
  Detection Detect(const Observation& observation, StageLog& log) const override;

 private:
  struct Candidate {
    FrameFitter fitter;
    FrameFit rough;
    double score;
  };
  struct Finished {
    FrameFit fit;
    WindowEstimate estimate;
  };
  std::vector<FrameSeed> Seeds(const std::vector<DarkQuadrilateral>& candidates,
                               const EdgeSegments& right_segments,
                               const cv::Mat1b& right_image) const;
  std::optional<Miss> Objection(std::span<const CameraView> views, const FrameFit& fit) const;
  Detection FitBest(const std::array<CameraView, 2>& views, const std::vector<FrameSeed>& seeds,
                    StageLog& log) const;
  std::variant<Finished, Miss> Finish(std::span<const CameraView> views,
                                      Candidate& candidate) const;

  EdgeStereoOptions options_;
  StereoCalibration calibration_;
  StereoRectification rectification_;
  FrameLimits limits_;
  DarknessSettings darkness_;
  FrameFitSettings fitting_;
};

}  // namespace fenestra
