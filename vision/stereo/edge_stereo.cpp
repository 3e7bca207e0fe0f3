#include "vision/stereo/edge_stereo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/input_error.h"
#include "vision/stereo/stage_pictures.h"

namespace fenestra {
namespace {

constexpr double kReach_px = 4.0;

const EdgeStereoOptions& Validated(const EdgeStereoOptions& options) {
  Validate(options);
  return options;
}

std::optional<SizePrior> Prior(const EdgeStereoOptions& options) {
  if (options.expected_width_m <= 0.0) return std::nullopt;
  return SizePrior{.width_m = options.expected_width_m,
                   .height_m = options.expected_height_m,
                   .sigma_m = options.expected_size_sigma_m};
}

const StereoObservation& StereoPart(const Observation& observation) {
  const auto* stereo = std::get_if<StereoObservation>(&observation);
  if (stereo == nullptr) {
    throw InputError("observation", "is of an RGB-D sensor; this detector needs a stereo pair");
  }
  return *stereo;
}

double Mean(const std::array<double, 4>& values) {
  return 0.25 * (values[0] + values[1] + values[2] + values[3]);
}

cv::Mat3b DrawSegments(const cv::Mat1b& image, const EdgeSegments& segments,
                       const std::vector<DarkQuadrilateral>& candidates) {
  cv::Mat3b picture;
  cv::cvtColor(image, picture, cv::COLOR_GRAY2BGR);
  const std::array<cv::Scalar, 4> colours = {
      cv::Scalar{0, 0, 255}, {0, 255, 255}, {255, 255, 0}, {255, 0, 0}};
  const auto point = [](const Eigen::Vector2d& p) {
    return cv::Point(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
  };
  for (size_t side = 0; side < 4; ++side) {
    for (const EdgeSegment& s : segments[side]) {
      cv::line(picture, point(s.from), point(s.to), colours[side]);
    }
  }
  for (const DarkQuadrilateral& candidate : candidates) {
    for (size_t i = 0; i < 4; ++i) {
      cv::line(picture, point(candidate.corners_px[i]), point(candidate.corners_px[(i + 1) % 4]),
               {255, 0, 255});
    }
  }
  return picture;
}

}  // namespace

EdgeStereoDetector::EdgeStereoDetector(const StereoCalibration& calibration,
                                       const EdgeStereoOptions& options)
    : options_(Validated(options)),
      calibration_(calibration),
      rectification_(calibration, options.rectification_alpha),
      limits_{.nearest_m = options.nearest_m,
              .farthest_m = options.farthest_m,
              .min_side_m = options.min_side_m,
              .max_side_m = options.max_side_m,
              .max_side_ratio = options.max_side_ratio,
              .max_skew_rad = options.max_skew_rad,
              .max_taper = options.max_taper},
      darkness_{
          .black_dn = options.black_dn, .noise_dn = options.min_contrast_dn / 3.0, .reach_px = 4.0},
      fitting_{.min_contrast_dn = options.min_contrast_dn,
               .reach_px = kReach_px,
               .min_side_support = options.min_side_support,
               .border = {.smallest_m = options.min_border_m,
                          .largest_share = options.max_border_share,
                          .min_contrast_dn = options.min_contrast_dn},
               .prior = Prior(options)} {}

Detection EdgeStereoDetector::Detect(const Observation& observation, StageLog& log) const {
  const StereoObservation& seen = StereoPart(observation);
  log.Begin("rectify");
  const RectifiedPair pair = rectification_.Rectify(seen);
  const std::array<PictureView, 2> picture_views = RectifiedViews(rectification_);
  log.Picture("rectified", [&] { return DrawRectifiedPair(pair); },
              {picture_views[0], picture_views[1]});

  log.Begin("segments");
  const EdgeSegmentSettings settings{.min_contrast_dn = options_.min_contrast_dn,
                                     .min_length_px = options_.min_segment_px,
                                     .most_per_side = options_.most_segments};
  const EdgeSegments left_segments = FindEdgeSegments(pair.left, settings);
  const EdgeSegments right_segments = FindEdgeSegments(pair.right, settings);

  log.Begin("propose");
  auto candidates = FindDarkQuadrilaterals(pair.left, left_segments, darkness_,
                                           static_cast<size_t>(4 * options_.most_candidates));
  std::erase_if(candidates, [&](const auto& q) { return q.clarity < options_.min_clarity; });
  log.Picture("segments", [&] { return DrawSegments(pair.left, left_segments, candidates); },
              {picture_views[0]});
  if (candidates.empty()) {
    log.End();
    return Miss{"no_quadrilateral", "no four edges around something dark"};
  }

  log.Begin("match");
  const std::vector<FrameSeed> seeds = Seeds(candidates, right_segments, pair.right);
  if (seeds.empty()) {
    log.End();
    return Miss{"no_stereo_match",
                fmt::format("{} dark quadrilaterals, none of them a rectangle in space",
                            candidates.size())};
  }

  log.Begin("fit");
  const std::array<CameraView, 2> views = {
      CameraView{calibration_.left, Pose(), seen.left},
      CameraView{calibration_.right, calibration_.X_RL, seen.right}};
  std::vector<WindowEstimate> found;
  std::optional<Miss> first_objection;
  for (const FrameSeed& seed : seeds) {
    std::array<Eigen::Vector3d, 4> p_LV;
    for (size_t i = 0; i < 4; ++i) p_LV[i] = rectification_.R_LF() * seed.p_FV[i];
    const auto result = FitFrame(views, FrameRectangle::FromCorners(p_LV), fitting_);
    std::optional<Miss> objection;
    if (const Miss* miss = std::get_if<Miss>(&result)) {
      objection = *miss;
    } else {
      const FrameFit& fit = std::get<FrameFit>(result);
      objection = Objection(fit.adjustment.frame);
      if (!objection) {
        WindowEstimate estimate = fit.adjustment.frame.ToEstimate();
        estimate.covariance_C = fit.adjustment.covariance.block<3, 3>(3, 3);
        estimate.score = Score(seed, fit);
        found.push_back(std::move(estimate));
      }
    }
    if (objection && !first_objection) first_objection = objection;
  }

  log.Begin("choose");
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.score.value() > b.score.value(); });
  log.End();
  if (found.empty()) return *first_objection;
  WindowEstimate best = found.front();
  best.others.assign(found.begin() + 1, found.end());
  return best;
}

std::vector<FrameSeed> EdgeStereoDetector::Seeds(const std::vector<DarkQuadrilateral>& candidates,
                                                 const EdgeSegments& right_segments,
                                                 const cv::Mat1b& right_image) const {
  std::vector<FrameSeed> seeds;
  for (const DarkQuadrilateral& candidate : candidates) {
    const auto more = FindSeeds(candidate, right_segments, right_image, rectification_.camera(),
                                limits_, darkness_);
    seeds.insert(seeds.end(), more.begin(), more.end());
  }
  std::stable_sort(seeds.begin(), seeds.end(),
                   [](const auto& a, const auto& b) { return a.clarity > b.clarity; });
  if (seeds.size() > static_cast<size_t>(options_.most_candidates)) {
    seeds.resize(static_cast<size_t>(options_.most_candidates));
  }
  return seeds;
}

std::optional<Miss> EdgeStereoDetector::Objection(const FrameRectangle& frame) const {
  const auto implausible = [](const std::string& detail) {
    return Miss{"implausible_shape", detail};
  };
  const double depth_m = frame.p_LO.z();
  if (depth_m < limits_.nearest_m || depth_m > limits_.farthest_m) {
    return implausible(fmt::format("depth {:.2f} m is out of range", depth_m));
  }
  const double shorter = std::min(frame.width_m, frame.height_m);
  const double longer = std::max(frame.width_m, frame.height_m);
  if (shorter < limits_.min_side_m || longer > limits_.max_side_m ||
      longer > limits_.max_side_ratio * shorter) {
    return implausible(fmt::format("{:.2f} x {:.2f} m", frame.width_m, frame.height_m));
  }
  return std::nullopt;
}

double EdgeStereoDetector::Score(const FrameSeed& seed, const FrameFit& fit) const {
  return 0.4 * seed.clarity + 0.4 * Mean(fit.outer_support) + 0.2 * fit.inner_support;
}

}  // namespace fenestra
