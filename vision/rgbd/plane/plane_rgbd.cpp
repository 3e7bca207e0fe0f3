#include "vision/rgbd/plane/plane_rgbd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/detection/observation.h"
#include "core/io/input_error.h"
#include "vision/frame/detection/edge_segments.h"
#include "vision/frame/frame_pictures.h"
#include "vision/frame/frame_score.h"
#include "vision/rgbd/plane/depth_points.h"
#include "vision/rgbd/plane/frame_paint.h"
#include "vision/rgbd/plane/frame_planes.h"
#include "vision/rgbd/rgbd_images.h"

namespace fenestra {
namespace {

// Half of a depth pixel's matching block, and a pixel for the uncertainty of the place that
// dominates the match.
constexpr double kClearWindows = 0.5;
constexpr double kClear_px = 1.0;
// Displacement of edges by what their model lacks, where there is little noise: blur that varies
// across an edge, and pixels that are not perfect squares.
constexpr double kEdgeShift_px = 0.0004;
constexpr double kLeastOfColor = 0.5;
// Largest ratio of the grey values of a frame's brightest and darkest sides, above what noise and
// blur leave of black. A frame has one paint, and the light on a wall hardly varies by so much
// within a window.
constexpr double kMostUneven = 4.0;
constexpr double kBlack_dn = 8.0;

const RgbdCalibration& Checked(const RgbdCalibration& calibration) {
  CheckDepthUnit(calibration);
  return calibration;
}

DepthNoise NoiseOf(const RgbdCalibration& calibration, const PlaneRgbdOptions& options,
                   const DepthPointReader& reader) {
  const int width_px = calibration.depth.width_px();
  const double window_px = std::max(1.0, options.depth_window_px * width_px / 640.0);
  return {.sigma = options.depth_noise_per_m,
          .step = options.depth_step_per_m,
          .window_px = window_px,
          .window_points = window_px * window_px / (reader.columns() * reader.rows()),
          .window_rad = window_px / calibration.depth.parameters().fx_px,
          .image = {width_px, calibration.depth.height_px()},
          .farthest = options.depth_to_m > 0.0 ? 1.0 / options.depth_to_m : 0.0};
}

// Marks in a depth image the points that were used: the wall green, points off its plane red, and
// the frame's front yellow.
cv::Mat3b DrawDepthUse(const DepthImage& depth, const FramePlanes& planes,
                       const DepthPointReader& reader) {
  cv::Mat1f depth_m;
  depth.raw.convertTo(depth_m, CV_32F, depth.unit_m);
  cv::Mat3b picture;
  DrawDepth(depth_m).convertTo(picture, CV_8U, 0.4);
  const auto mark = [&](const DepthPoint& point, const cv::Vec3b& colour) {
    const cv::Rect place =
        cv::Rect(point.pixel.x - reader.columns() / 2, point.pixel.y - reader.rows() / 2,
                 reader.columns(), reader.rows()) &
        cv::Rect({0, 0}, picture.size());
    picture(place).setTo(colour);
  };
  for (size_t i = 0; i < planes.points.wall.size(); ++i) {
    mark(planes.points.wall[i],
         planes.wall.is_inlier[i] ? cv::Vec3b(80, 200, 80) : cv::Vec3b(60, 60, 230));
  }
  for (const DepthPoint& point : planes.points.border) mark(point, {60, 220, 230});
  return picture;
}

}  // namespace

struct PlaneRgbdDetector::Finished {
  FrameFit fit;
  FramePlanes planes;
  WindowEstimate estimate;
};

PlaneRgbdDetector::PlaneRgbdDetector(const RgbdCalibration& calibration,
                                     const PlaneRgbdOptions& options)
    : options_(Validated(options)),
      calibration_(Checked(calibration)),
      pinhole_(WithoutDistortion(calibration.color)),
      reader_({pinhole_, calibration.depth, calibration.X_KD, calibration.depth_unit_m}),
      darkness_{
          .black_dn = 0.0, .min_contrast_dn = options.search.min_contrast_dn, .reach_px = 4.0},
      fitting_{.min_contrast_dn = options.search.min_contrast_dn,
               .min_side_support = options.search.min_side_support,
               .border = {.smallest_m = options.search.min_border_m,
                          .largest_share = options.search.max_border_share,
                          .min_contrast_dn = options.search.min_contrast_dn},
               .size = SizePriorOf(options.prior),
               .planes = {},
               .vignetting = {.black_dn = 0.0, .power = options.search.vignetting_power},
               .shift = {.centre_px = kEdgeShift_px, .corner_px = kEdgeShift_px}},
      noise_(NoiseOf(calibration, options, reader_)),
      limits_(options.search.limits),
      clear_px_(kClearWindows * noise_.window_px + kClear_px * reader_.columns()) {
  if (calibration.color.has_distortion()) undistortion_ = UndistortionMap(calibration.color);
}

Detection PlaneRgbdDetector::Detect(const Observation& observation, StageLog& log) const {
  const RgbdObservation& seen = RgbdPart(observation);
  CheckFits(seen, calibration_);
  log.Begin("read");
  const cv::Mat1b grey = LinearGrey(seen.color);
  cv::Mat1b straight = grey;
  if (!undistortion_.empty()) {
    straight = cv::Mat1b();
    cv::remap(grey, straight, undistortion_, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }
  const std::vector<DepthPoint> points = reader_.Read(seen.depth);

  log.Begin("segments");
  const EdgeSegments segments =
      FindEdgeSegments(straight, {.min_length_px = options_.search.min_segment_px,
                                  .min_darkness = options_.search.min_darkness,
                                  .most_per_side = options_.search.most_segments,
                                  .darkness = darkness_});
  log.Begin("propose");
  const auto candidates =
      FindDarkQuadrilaterals(straight, segments, darkness_, options_.search.min_darkness,
                             2 * static_cast<size_t>(options_.search.most_candidates));
  log.Picture("segments", [&] { return DrawSegments(straight, segments, candidates); },
              {PictureView{pinhole_, calibration_.X_KD}});
  log.Begin("plane");
  std::variant<std::vector<PlaneSeed>, Miss> seeds = Seeds(candidates, points);
  log.Begin("fit");
  Detection detection = Miss{};
  if (const Miss* miss = std::get_if<Miss>(&seeds)) {
    detection = *miss;
  } else {
    const CameraView view{calibration_.color, calibration_.X_KD, grey};
    detection = FitBest({seen, view, points}, std::get<std::vector<PlaneSeed>>(seeds), log);
  }
  log.End();
  return detection;
}

std::variant<std::vector<PlaneSeed>, Miss> PlaneRgbdDetector::Seeds(
    const std::vector<DarkQuadrilateral>& candidates, const std::vector<DepthPoint>& points) const {
  if (candidates.empty()) return Miss{"no_quadrilateral", "no four edges around something dark"};
  // The same angle as clear_px_, in pixels of the colour image.
  const double clear_px =
      clear_px_ * pinhole_.parameters().fx_px / calibration_.depth.parameters().fx_px;
  PlaneSeeds found = FindPlaneSeeds(
      candidates, points, pinhole_, calibration_.X_KD,
      {.limits = limits_, .noise = noise_, .setback_m = options_.setback_m, .clear_px = clear_px});
  if (found.seeds.empty()) {
    if (found.without_plane == static_cast<int>(candidates.size())) {
      return Miss{"no_depth", fmt::format("{} dark quadrilaterals, no plane around any of them",
                                          candidates.size())};
    }
    return Miss{"not_a_rectangle",
                fmt::format("{} dark quadrilaterals, none of them a rectangle on the plane "
                            "around it",
                            candidates.size())};
  }
  if (found.seeds.size() > static_cast<size_t>(options_.search.most_candidates)) {
    found.seeds.resize(static_cast<size_t>(options_.search.most_candidates));
  }
  return std::move(found.seeds);
}

std::variant<PlaneRgbdDetector::Finished, Miss> PlaneRgbdDetector::Finish(
    const Scene& scene, Candidate& candidate) const {
  const CameraView& view = scene.view;
  FrameFit rough = candidate.rough;
  FrameRectangle& frame = rough.adjustment.frame;
  const auto border = FindBorder({&view, 1}, frame, fitting_.border);
  frame.border_m = border ? border->border_m : GuessedBorder(frame);
  auto measured = MeasureFramePlanes(scene.points, frame, candidate.seed.wall, calibration_.depth,
                                     {.noise = noise_,
                                      .clear_px = clear_px_,
                                      .setback_m = options_.setback_m,
                                      .setback_sigma_m = options_.setback_sigma_m,
                                      .fits_setback = fitting_.size.has_value()});
  if (const Miss* miss = std::get_if<Miss>(&measured)) return *miss;
  FramePlanes& planes = std::get<FramePlanes>(measured);
  if (planes.setback_m != options_.setback_m) {
    const Eigen::Vector3d p_DK = calibration_.X_KD.inverse().translation();
    frame.outer_relief_m = {};
    frame = WithHiddenSides(SetBack(frame, p_DK, planes.setback_m - options_.setback_m), p_DK,
                            planes.setback_m);
  }
  candidate.fitter.UsePlanes(planes.planes);
  auto result = candidate.fitter.Finish(rough);
  if (const Miss* miss = std::get_if<Miss>(&result)) return *miss;
  Finished finished{std::move(std::get<FrameFit>(result)), std::move(planes), {}};
  AddSetback(view, fitting_.size.has_value(), finished.planes, finished.fit);
  const FrameRectangle& fitted = finished.fit.adjustment.frame;
  if (auto objection = Objection(scene, fitted)) return *objection;
  finished.estimate = EstimateOf({&view, 1}, finished.fit, candidate.score, darkness_);
  return finished;
}

std::optional<Miss> PlaneRgbdDetector::Objection(const Scene& scene,
                                                 const FrameRectangle& fitted) const {
  if (auto objection = ObjectionToFrame(fitted, limits_)) return objection;
  if (auto objection =
          ObjectionToClarity({&scene.view, 1}, fitted, darkness_, options_.search.min_darkness)) {
    return objection;
  }
  const double uneven = BrightestOverDarkestSide(scene.view, fitted, kBlack_dn);
  if (uneven > kMostUneven) {
    return Miss{"uneven_border", fmt::format("one side of the frame is {:.1f} times as bright as "
                                             "another, {:.1f} are allowed",
                                             uneven, kMostUneven)};
  }
  if (!options_.prior.knows_color()) return std::nullopt;
  const double share = ShareOfColor(scene.view, fitted, options_.prior, scene.images.color);
  if (share >= kLeastOfColor) return std::nullopt;
  return Miss{"unexpected_color", fmt::format("only {:.0f} % of the frame has its colour, {:.0f} % "
                                              "are needed",
                                              100.0 * share, 100.0 * kLeastOfColor)};
}

Detection PlaneRgbdDetector::FitBest(const Scene& scene, const std::vector<PlaneSeed>& seeds,
                                     StageLog& log) const {
  const CameraView& view = scene.view;
  const std::span<const CameraView> views(&view, 1);
  std::optional<Miss> objection;
  std::vector<Candidate> candidates;
  for (const PlaneSeed& seed : seeds) {
    FrameFitSettings settings = fitting_;
    settings.planes = {
        {.m = seed.wall.m, .information = seed.wall.information, .relief_m = options_.setback_m}};
    FrameFitter fitter(views, settings);
    auto rough = fitter.FitRoughly(seed.frame);
    if (!rough) continue;
    if (const auto other = ObjectionToPrior(rough->adjustment.frame, options_.prior)) {
      if (!objection) objection = other;
      continue;
    }
    const double score = FrameScore(views, *rough, darkness_);
    candidates.push_back({seed, std::move(fitter), std::move(*rough), score});
  }
  const BestFits best = FinishBest(std::move(candidates), options_.search.most_windows,
                                   [&](Candidate& candidate) { return Finish(scene, candidate); });
  if (!objection) objection = best.objection;
  if (best.found.empty()) {
    return objection.value_or(Miss{"no_edges", "too few edge points to fix a rectangle"});
  }
  log.Begin("choose");
  const Finished& chosen = best.found.front();
  log.Picture("edge_points", [&] { return DrawEdgePoints(views, chosen.fit); },
              {PictureView{view.camera, view.X_CL}});
  log.Picture("depth_use", [&] { return DrawDepthUse(scene.images.depth, chosen.planes, reader_); },
              {PictureView{calibration_.depth, Pose()}});
  return best.Chosen();
}

}  // namespace fenestra
