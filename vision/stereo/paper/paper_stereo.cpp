#include "vision/stereo/paper/paper_stereo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/frame/detection/darkness.h"
#include "vision/stereo/paper/block_matching.h"
#include "vision/stereo/paper/closed_contour.h"
#include "vision/stereo/paper/window_rectangle.h"
#include "vision/stereo/rectification.h"

namespace fenestra {
namespace {

FrameCriteria Criteria(const PaperStereoOptions& options) {
  return {.window_px = options.sad_window_px,
          .plane_tolerance_px = options.plane_tolerance_px,
          .min_inlier_share = options.min_inlier_share,
          .min_row_overlap = options.min_row_overlap,
          .min_side_support = options.min_side_support,
          .max_opening_rows = options.max_opening_rows,
          .nearest_m = options.nearest_m,
          .farthest_m = options.farthest_m,
          .min_side_m = options.min_side_m,
          .max_side_m = options.max_side_m,
          .max_side_ratio = options.max_side_ratio,
          .max_skew_rad = options.max_skew_rad,
          .max_taper = options.max_taper,
          .prior = options.prior};
}

// Draws depth in false colours, near red and far blue; pixels without depth are black.
cv::Mat3b DrawDepth(const cv::Mat1f& depth_m, const DepthRange& range) {
  // Equal steps of colour are equal steps of 1/z, and so of disparity.
  cv::Mat1f inverse;
  cv::divide(1.0, depth_m, inverse);
  const double far = 1.0 / range.farthest_m;
  const double scale = 255.0 / (1.0 / range.nearest_m - far);
  cv::Mat1b gray;
  inverse.convertTo(gray, CV_8U, scale, -scale * far);
  cv::Mat3b picture;
  cv::applyColorMap(gray, picture, cv::COLORMAP_TURBO);
  picture.setTo(cv::Scalar::all(0), depth_m <= 0.0f);
  return picture;
}

// Places DetectEdges' result for a box of an image into an image of the given size.
cv::Mat1b DrawEdges(const cv::Mat1b& edges, const cv::Rect& box, const cv::Size& size) {
  cv::Mat1b whole(size.height + 2 * kEdgeRim_px, size.width + 2 * kEdgeRim_px, uint8_t{0});
  edges.copyTo(whole(cv::Rect(box.tl(), edges.size())));
  return whole(cv::Rect({kEdgeRim_px, kEdgeRim_px}, size)).clone();
}

}  // namespace

BlockMatchingSettings MatchingSettings(const PaperStereoOptions& options,
                                       const RectifiedCamera& camera, int width_px) {
  // A disparity of at least the image's width leaves nothing to match.
  const auto limited = [width_px](double d) { return std::clamp(d, 0.0, width_px - 1.0); };
  return {.window_px = options.sad_window_px,
          .nearest_disparity_px =
              static_cast<int>(limited(std::ceil(camera.DisparityFromDepth(options.nearest_m)))),
          .farthest_disparity_px =
              static_cast<int>(limited(std::floor(camera.DisparityFromDepth(options.farthest_m)))),
          .uniqueness_percent = options.uniqueness_percent,
          .texture_threshold = options.texture_threshold,
          .speckle_area_px = options.speckle_area_px,
          .speckle_step_px = options.speckle_step_px,
          .left_right_check = options.left_right_check};
}

PaperStereoDetector::PaperStereoDetector(const StereoCalibration& calibration,
                                         const PaperStereoOptions& options)
    : options_(Validated(options)),
      rectification_(calibration, options.rectification_alpha),
      matching_(MatchingSettings(options, rectification_.camera(), calibration.left.width_px())),
      patches_{.opening_px = options.opening_px,
               .gap_height_px = options.gap_height_px,
               .gap_width_px = options.gap_width_px,
               .min_height_px = options.min_band_height_px,
               .disparity_step_px = options.speckle_step_px},
      criteria_(Criteria(options)),
      range_{options.nearest_m, options.farthest_m},
      errors_{.window_px = static_cast<double>(options.sad_window_px),
              .subpixel_bias_px = options.subpixel_bias_px,
              .contour_px = options.contour_sigma_px} {}

Detection PaperStereoDetector::Detect(const Observation& observation, StageLog& log) const {
  log.Begin("rectify");
  const RectifiedPair pair = rectification_.Rectify(StereoPart(observation));
  const std::array<PictureView, 2> views = RectifiedViews(rectification_);
  log.Picture("rectified", [&] { return DrawRectifiedPair(pair); }, {views[0], views[1]});

  log.Begin("match");
  Matches matches = Match(pair);
  Frames frames = FindFramesIn(matches);
  if (options_.guided_search && std::holds_alternative<Miss>(frames)) {
    if (auto again = MatchAgain(pair, matches)) {
      matches = std::move(*again);
      frames = FindFramesIn(matches);
    }
  }

  log.Begin("depth_image");
  const cv::Mat1f depth_m = DepthFromDisparity(matches.disparity, rectification_.camera());
  log.Picture("depth_image", [&] { return DrawDepth(depth_m, range_); }, {views[0]});

  log.Begin("close_gaps");
  Detection detection = Miss{};
  if (const Miss* miss = std::get_if<Miss>(&frames)) {
    detection = *miss;
  } else {
    detection = FindWindows(pair, matches, std::get<std::vector<FrameHypothesis>>(frames), log);
  }
  log.End();
  return detection;
}

Detection PaperStereoDetector::FindWindows(const RectifiedPair& pair, const Matches& matches,
                                           const std::vector<FrameHypothesis>& frames,
                                           StageLog& log) const {
  std::optional<Miss> first_miss;
  std::vector<WindowEstimate> windows;
  for (const FrameHypothesis& frame : frames) {
    log.Begin("close_gaps");
    const DepthPatch closed =
        CloseGaps(matches.disparity, frame.hull, frame.plane, options_.plane_tolerance_px,
                  options_.sad_window_px, rectification_.camera());
    const Detection one = MeasureFrame(pair, frame, closed, log, windows.empty() && !first_miss);
    if (const auto* window = std::get_if<WindowEstimate>(&one)) {
      windows.push_back(*window);
    } else if (!first_miss) {
      first_miss = std::get<Miss>(one);
    }
  }
  if (windows.empty()) return *first_miss;
  WindowEstimate best = windows.front();
  best.others.assign(windows.begin() + 1, windows.end());
  return best;
}

Detection PaperStereoDetector::MeasureFrame(const RectifiedPair& pair, const FrameHypothesis& frame,
                                            const DepthPatch& closed, StageLog& log,
                                            bool with_pictures) const {
  const PictureView view = RectifiedViews(rectification_)[0];
  const cv::Size size = pair.left.size();
  if (with_pictures) {
    log.Picture("closed_contour", [&] { return DrawDepth(closed.In(size), range_); }, {view});
  }
  log.Begin("edges");
  const cv::Mat1b edges = DetectEdges(ToEightBit(closed.depth_m, range_),
                                      {options_.canny_low_dn, options_.canny_high_dn});
  if (with_pictures) {
    log.Picture("edges", [&] { return DrawEdges(edges, closed.box, size); }, {view});
  }
  log.Begin("contour");
  auto contour = LargestClosedContour(edges);
  if (!contour) return Miss{"no_contour", "no edge of the depth image is a closed curve"};
  for (cv::Point& point : *contour) point += closed.box.tl();
  const auto corners_px = FindCorners(*contour);
  if (!corners_px) {
    return Miss{"not_a_quadrilateral",
                fmt::format("a closed contour of {} px has no four sides", contour->size())};
  }

  log.Begin("centroid");
  const auto estimate_F = WindowOnPlane(*corners_px, frame.plane, rectification_.camera());
  if (!estimate_F) return Miss{"implausible_shape", "the frame's plane meets the horizon"};
  if (auto objection = ObjectionToShape(*estimate_F, criteria_)) return *objection;
  if (options_.prior.knows_grey()) {
    const double ratio = DarkOverBright(pair.left, {corners_px->begin(), corners_px->end()},
                                        {.black_dn = options_.black_dn,
                                         .min_contrast_dn = 1.0,
                                         .reach_px = 0.5 * options_.sad_window_px});
    if (auto objection = ObjectionOf(options_.prior, ratio)) return *objection;
  }
  return Rotated(rectification_.R_LF(), WithCovariance(*estimate_F, frame));
}

WindowEstimate PaperStereoDetector::WithCovariance(const WindowEstimate& estimate_F,
                                                   const FrameHypothesis& frame) const {
  const RectifiedCamera& camera = rectification_.camera();
  const Eigen::Vector3d& p_FO = estimate_F.p_CO;
  const Eigen::Vector2d pixel(camera.f_px * p_FO.x() / p_FO.z() + camera.cx_px,
                              camera.f_px * p_FO.y() / p_FO.z() + camera.cy_px);
  WindowEstimate estimate = estimate_F;
  estimate.score = frame.score;
  if (const auto variance_px2 = DisparityVariance(frame.patches, frame.plane,
                                                  options_.plane_tolerance_px, pixel, errors_)) {
    estimate.covariance_C = CentreCovariance(pixel, frame.plane, *variance_px2, camera, errors_);
  }
  return estimate;
}

PaperStereoDetector::Matches PaperStereoDetector::Match(const RectifiedPair& pair) const {
  const cv::Mat1f disparity =
      MatchBlocks(pair, rectification_.left_seen(), rectification_.right_seen(), matching_);
  return {disparity, FindPatches(disparity, patches_)};
}

std::optional<PaperStereoDetector::Matches> PaperStereoDetector::MatchAgain(
    const RectifiedPair& pair, const Matches& matches) const {
  const auto again = MatchAgainNearPatches(
      pair, rectification_.left_seen(), rectification_.right_seen(), matching_, matches.disparity,
      matches.patches, options_.min_side_m / rectification_.camera().baseline_m);
  if (!again) return std::nullopt;
  return Matches{*again, FindPatches(*again, patches_)};
}

PaperStereoDetector::Frames PaperStereoDetector::FindFramesIn(const Matches& matches) const {
  if (matches.patches.empty()) {
    return Miss{"no_matches",
                fmt::format("no matched patch is {} px tall; {} pixels are matched",
                            patches_.min_height_px, cv::countNonZero(matches.disparity))};
  }
  return FindFrames(matches.patches, matches.disparity, rectification_.camera(), criteria_,
                    static_cast<size_t>(options_.most_windows));
}

std::optional<Quadrilateral> PaperStereoDetector::FindCorners(
    const std::vector<cv::Point>& contour) const {
  auto corners_px = FitQuadrilateral(contour);
  if (!corners_px) return std::nullopt;
  for (Eigen::Vector2d& corner : *corners_px) corner.array() += 0.5;  // See closed_contour.h.
  if (!options_.undo_fattening) return corners_px;
  const int reach_px = options_.sad_window_px / 2;
  return Inset(*corners_px, reach_px);
}

}  // namespace fenestra
