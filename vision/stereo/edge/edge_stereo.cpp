#include "vision/stereo/edge/edge_stereo.h"

#include <fmt/format.h>

#include "core/io/faults.h"
#include "vision/frame/detection/edge_segments.h"
#include "vision/frame/frame_pictures.h"
#include "vision/frame/frame_score.h"
#include "vision/stereo/rectification.h"

namespace fenestra {
namespace {

using Options = EdgeStereoOptions;
using Table = ParameterTable<Options>;

// Least contrast of the inner sides relative to the outer ones. There is little contrast between
// frame and opening in front of a dark room, but the mean is over the whole length of the sides.
constexpr double kInnerContrast = 0.4;
constexpr double kOpening = 0.5;  // Least share of the places along the inner sides.
constexpr double kLight = 0.9;    // See BrightBand.

}  // namespace

const Table& EdgeStereoParameters() {
  static const Table table = [] {
    Table made;
    made.Number(
        "rectification_alpha", FENESTRA_FIELD(rectification_alpha), {0.0, 1.0},
        "Zoom of rectification: 0 keeps only what both sensors saw, 1 all that either saw.");
    made.Adopt<FrameSearchOptions>(FrameSearchParameters(), FENESTRA_FIELD(search));
    made.Number("black_dn", FENESTRA_FIELD(black_dn), {0.0, 255.0}, "Grey value without light.");
    made.Number("edge_shift_px", FENESTRA_FIELD(edge_shift.centre_px), {0.0, 10.0},
                "Standard deviation of edges' displacement by what the edge model lacks, in the "
                "image's centre: coma, motion between exposures.");
    made.Number("corner_edge_shift_px", FENESTRA_FIELD(edge_shift.corner_px), {0.0, 10.0},
                "The same in the image's corners.");
    made.Adopt<WindowPrior>(PriorParameters(SensorKind::kStereo), FENESTRA_FIELD(prior));
    return made;
  }();
  return table;
}

void Validate(const Options& options) {
  Faults faults("edge-stereo");
  faults.Add(EdgeStereoParameters().Objections(options));
  faults.Add(FaultsOf(options.search));
  faults.Add(FaultsOf(options.prior));
  faults.ThrowIfAny();
}

EdgeStereoDetector::EdgeStereoDetector(const StereoCalibration& calibration,
                                       const EdgeStereoOptions& options)
    : options_(Validated(options)),
      calibration_(calibration),
      rectification_(calibration, options.rectification_alpha),
      limits_(options.search.limits),
      darkness_{.black_dn = options.black_dn,
                .min_contrast_dn = options.search.min_contrast_dn,
                .reach_px = 4.0},
      fitting_{
          .min_contrast_dn = options.search.min_contrast_dn,
          .min_side_support = options.search.min_side_support,
          .border = {.smallest_m = options.search.min_border_m,
                     .largest_share = options.search.max_border_share,
                     .min_contrast_dn = kInnerContrast * options.search.min_contrast_dn},
          .size = SizePriorOf(options.prior),
          .planes = {},
          .vignetting = {.black_dn = options.black_dn, .power = options.search.vignetting_power},
          .shift = options.edge_shift} {}

Detection EdgeStereoDetector::Detect(const Observation& observation, StageLog& log) const {
  const StereoObservation& seen = StereoPart(observation);
  log.Begin("rectify");
  const RectifiedPair pair = rectification_.Rectify(seen);
  const std::array<PictureView, 2> picture_views = RectifiedViews(rectification_);
  log.Picture("rectified", [&] { return DrawRectifiedPair(pair); },
              {picture_views[0], picture_views[1]});

  log.Begin("segments");
  const EdgeSegmentSettings settings{.min_length_px = options_.search.min_segment_px,
                                     .min_darkness = options_.search.min_darkness,
                                     .most_per_side = options_.search.most_segments,
                                     .darkness = darkness_};
  const EdgeSegments left_segments = FindEdgeSegments(pair.left, settings);
  const EdgeSegments right_segments = FindEdgeSegments(pair.right, settings);

  log.Begin("propose");
  const auto candidates =
      FindDarkQuadrilaterals(pair.left, left_segments, darkness_, options_.search.min_darkness,
                             4 * static_cast<size_t>(options_.search.most_candidates));
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
  Detection detection = FitBest(views, seeds, log);
  log.End();
  return detection;
}

Detection EdgeStereoDetector::FitBest(const std::array<CameraView, 2>& views,
                                      const std::vector<FrameSeed>& seeds, StageLog& log) const {
  std::vector<Candidate> candidates;
  Miss last_objection{"no_edges", "too few edge points to fix a rectangle"};
  for (const FrameSeed& seed : seeds) {
    std::array<Eigen::Vector3d, 4> p_LV;
    for (size_t i = 0; i < 4; ++i) p_LV[i] = rectification_.R_LF() * seed.p_FV[i];
    FrameFitter fitter(views, fitting_);
    auto rough = fitter.FitRoughly(FrameRectangle::FromCorners(p_LV));
    if (!rough) continue;
    if (auto objection = ObjectionToPrior(rough->adjustment.frame, options_.prior)) {
      last_objection = *objection;
      continue;
    }
    const double score = FrameScore(views, *rough, darkness_);
    candidates.push_back({std::move(fitter), std::move(*rough), score});
  }
  if (candidates.empty()) return last_objection;
  const BestFits best = FinishBest(std::move(candidates), options_.search.most_windows,
                                   [&](Candidate& candidate) { return Finish(views, candidate); });
  if (best.found.empty()) return *best.objection;
  log.Begin("choose");
  log.Picture("edge_points", [&] { return DrawEdgePoints(views, best.found.front().fit); },
              {PictureView{views[0].camera, Pose()}});
  return best.Chosen();
}

std::variant<EdgeStereoDetector::Finished, Miss> EdgeStereoDetector::Finish(
    std::span<const CameraView> views, Candidate& candidate) const {
  auto result = candidate.fitter.Finish(candidate.rough);
  if (const Miss* miss = std::get_if<Miss>(&result)) return *miss;
  Finished finished{std::move(std::get<FrameFit>(result)), {}};
  if (auto objection = Objection(views, finished.fit)) return *objection;
  finished.estimate = EstimateOf(views, finished.fit, candidate.score, darkness_);
  return finished;
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
  return ClearestSeeds(std::move(seeds), static_cast<size_t>(options_.search.most_candidates));
}

std::optional<Miss> EdgeStereoDetector::Objection(std::span<const CameraView> views,
                                                  const FrameFit& fit) const {
  const FrameRectangle& frame = fit.adjustment.frame;
  if (auto objection = ObjectionToFrame(frame, limits_)) return objection;
  if (auto objection = ObjectionToClarity(views, frame, darkness_, options_.search.min_darkness)) {
    return objection;
  }
  // A dark area without an opening of its own is the opening of a light frame.
  if (fit.inner_support < kOpening && BrightBand(views, frame, options_.black_dn) > kLight) {
    return Miss{"light_frame", "what surrounds it is lighter than the wall"};
  }
  if (!options_.prior.knows_grey()) return std::nullopt;
  return ObjectionOf(options_.prior, FrameGreyRatio(views, frame, darkness_));
}

}  // namespace fenestra
