#include "vision/frame/frame_fitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vision/frame/adjustment/frame_fit.h"
#include "vision/frame/measurement/edge_points.h"
#include "vision/frame/setback/settle_depth.h"

namespace fenestra {
namespace {

// Edges are known to hundredths of a pixel, so where the model is wrong by a pixel the loss would
// reject a whole side at once. The first rounds therefore treat all points as if they had this
// uncertainty.
constexpr double kRoughTolerance_px = 0.7;
constexpr std::array<double, 3> kPlaneTolerances_px = {0.3, 0.0, 0.0};
// Tolerance from which on every third strip suffices in a round that is not the last.
constexpr double kCoarse_px = 0.3;
// Sides in relief are less straight and less parallel than a frame's own.
constexpr std::array<double, 3> kReliefTolerances_px = {0.3, 0.1, 0.05};
constexpr std::array<double, 3> kCoarseTolerances_px = {0.7, 0.7, 0.7};
constexpr double kLeastReach_px = 1.6;
// Least share of the places along the inner sides; with less, the border is left out.
constexpr double kLeastInnerSupport = 0.5;
// Least share for each inner side, since the upper and lower ones alone do not determine their
// depth.
constexpr double kLeastOfInnerSide = 0.3;
// With less in a first round, further rounds are futile.
constexpr double kHopelessSupport = 0.3;
// Largest residuals of a correct model: in standard deviations, or the effect of rounding on edges
// along rows. If half of a side's edges lie in either of two planes, both are exceeded.
constexpr double kMostScale = 2.5;
constexpr double kMostOff_px = 0.03;
// A relief of the inner sides is significant from this many standard deviations on.
constexpr double kSignificant = 3.0;
// Least share of the places along each outer side for a frame in one plane.
constexpr double kFlatSupport = 0.5;
// A wall's face or a sill is up to about a decimetre in front of the frame; see also kPanes.
constexpr ReliefPrior kWall{.mean_m = 0.05, .sigma_m = 0.06};
// Reliefs that are less certain than this are left out.
constexpr double kMostRelief_m = 0.05;
const FramePrior kFree{
    .size = {}, .outer_relief = {}, .inner_relief = ReliefPrior{.mean_m = -0.05, .sigma_m = 0.1}};

// Width of the border in the image where it is narrowest.
double BorderPixels(const CameraView& view, const FrameRectangle& frame) {
  double least = 1e9;
  for (const Side side : kAllSides) {
    const auto outer = view.camera.Project(view.X_CL * frame.PointOn(side, Border::kOuter, 0.5));
    const auto inner = view.camera.Project(view.X_CL * frame.PointOn(side, Border::kInner, 0.5));
    if (outer && inner) least = std::min(least, (*outer - *inner).norm());
  }
  return least;
}

bool IsConsistent(const FrameFit& fit) {
  double sum_px = 0.0;
  double count = 0.0;
  for (const std::vector<EdgePoint>& view : fit.points) {
    for (const EdgePoint& point : view) sum_px += point.sigma_px;
    count += static_cast<double>(view.size());
  }
  const double scale = fit.adjustment.scale;
  return scale < kMostScale || scale * sum_px / count < kMostOff_px;
}

bool HasInnerSides(const FrameFit& fit) {
  return fit.inner_support >= kLeastInnerSupport && fit.LeastInnerSupport() >= kLeastOfInnerSide;
}

RevealGrey RevealGreyOf(const FrameFitSettings& settings) {
  return {.black_dn = settings.vignetting.black_dn, .min_contrast_dn = settings.min_contrast_dn};
}

double SigmaAlongNormal(const FrameFit& fit) {
  const Eigen::Vector3d normal = fit.adjustment.frame.R_LO.col(2);
  return std::sqrt(normal.dot(fit.adjustment.covariance.block<3, 3>(3, 3) * normal));
}

}  // namespace

SideEdges FrameFitter::Measure(size_t view, const FrameRectangle& frame,
                               const SideRequest& request) {
  EdgeNuisance& nuisance =
      nuisances_[view][static_cast<size_t>(request.border)][static_cast<size_t>(request.side)];
  SideEdges edges = MeasureSide(views_[view], frame, request, nuisance);
  nuisance = edges.nuisance;
  return edges;
}

FrameFitter::ViewEdges FrameFitter::MeasureView(size_t view, const FrameRectangle& frame,
                                                double tolerance_px, bool is_last) {
  const double reach_px = border_ ? std::clamp(0.5 * BorderPixels(views_[view], frame),
                                               kLeastReach_px, settings_.reach_px)
                                  : settings_.reach_px;
  ViewEdges found;
  const auto add = [&](const SideRequest& request, SideCounts& places) {
    const SideEdges edges = Measure(view, frame, request);
    found.points.insert(found.points.end(), edges.points.begin(), edges.points.end());
    places[static_cast<size_t>(request.side)] = edges.places;
  };
  for (const Side side : kAllSides) {
    SideRequest request{
        .side = side,
        .border = Border::kOuter,
        .brighter = Brighter::kOutside,
        .reach_px = reach_px,
        .far_px = tolerance_px > 0.0 ? reach_px : std::max(reach_px, settings_.far_px),
        .min_contrast_dn = settings_.min_contrast_dn,
        .vignetting = settings_.vignetting,
        .shift = settings_.shift,
        .coarse = !is_last && tolerance_px >= kCoarse_px};
    add(request, found.outer_places);
    if (!border_) continue;
    request.border = Border::kInner;
    request.brighter = border_->brighter[static_cast<size_t>(side)];
    request.min_contrast_dn = settings_.border.min_contrast_dn;
    add(request, found.inner_places);
  }
  for (EdgePoint& point : found.points) point.sigma_px = std::hypot(point.sigma_px, tolerance_px);
  return found;
}

std::optional<FrameFit> FrameFitter::Round(const FrameRectangle& frame, const FramePrior& prior,
                                           double tolerance_px, bool is_last) {
  FrameFit fit;
  PlaceCounts places;
  for (size_t view = 0; view < views_.size(); ++view) {
    ViewEdges found = MeasureView(view, frame, tolerance_px, is_last);
    fit.points.push_back(std::move(found.points));
    places.outer.push_back(found.outer_places);
    places.inner.push_back(found.inner_places);
  }
  FramePrior all = prior;
  all.planes = settings_.planes;
  auto adjustment = AdjustFrame(views_, fit.points, frame, all);
  if (!adjustment) return std::nullopt;
  fit.adjustment = std::move(*adjustment);
  CountSupport(places, fit);
  return fit;
}

std::optional<FrameFit> FrameFitter::Rounds(FrameFit fit, const FramePrior& prior,
                                            std::span<const double> tolerances_px) {
  for (size_t i = 0; i < tolerances_px.size(); ++i) {
    FramePrior now = prior;
    const bool is_last = i + 1 == tolerances_px.size();
    if (is_last) now.size = settings_.size;
    auto next = Round(fit.adjustment.frame, now, tolerances_px[i], is_last);
    if (!next) return std::nullopt;
    fit = std::move(*next);
  }
  return fit;
}

std::optional<FrameFit> FrameFitter::FitRoughly(const FrameRectangle& start) {
  return Round(start, {}, kRoughTolerance_px, false);
}

std::optional<FrameFit> FrameFitter::FitInOnePlane(const FrameFit& start) {
  auto fit = Round(start.adjustment.frame, {}, kPlaneTolerances_px[0], false);
  // One round tells whether the inner sides are in that plane at all.
  if (!fit || (border_ && fit->inner_support < kHopelessSupport)) return std::nullopt;
  fit = Rounds(std::move(*fit), {}, std::span(kPlaneTolerances_px).subspan<1>());
  if (!fit || fit->LeastSupport() < kFlatSupport) return std::nullopt;
  if (border_) {
    if (!HasInnerSides(*fit) || !IsConsistent(*fit)) return std::nullopt;
    // Another plane must not explain them better.
    FramePrior free = kFree;
    free.planes = settings_.planes;
    const auto freed = AdjustFrame(views_, fit->points, fit->adjustment.frame, free);
    if (freed && std::abs(freed->frame.inner_relief_m) >
                     kSignificant * std::sqrt(freed->covariance(13, 13))) {
      return std::nullopt;
    }
  }
  fit->is_in_one_plane = border_.has_value();
  return fit;
}

std::optional<FrameFit> FrameFitter::FitBeforePanes(const FrameFit& start) {
  auto fit = Round(start.adjustment.frame, kFree, kPlaneTolerances_px[0], false);
  if (fit && fit->inner_support >= kHopelessSupport) {
    fit = Rounds(std::move(*fit), kFree, std::span(kPlaneTolerances_px).subspan<1>());
  } else {
    fit.reset();
  }
  if (!fit || fit->LeastSupport() < kFlatSupport || !HasInnerSides(*fit) || !IsConsistent(*fit)) {
    border_.reset();
    fit = Rounds(start, {}, kPlaneTolerances_px);
  }
  if (!fit || fit->LeastSupport() < kFlatSupport) return std::nullopt;
  return fit;
}

std::optional<FrameFit> FrameFitter::FitInRelief(const FrameFit& start) {
  auto fit = Rounds(start, {.size = {}, .outer_relief = kWall, .inner_relief = kPanes},
                    kReliefTolerances_px);
  if (!fit || fit->LeastSupport() < settings_.min_side_support ||
      SigmaAlongNormal(*fit) > kMostRelief_m) {
    border_.reset();
    fit = Rounds(start, {}, kCoarseTolerances_px);
  }
  if (fit) fit->is_flat = false;
  return fit;
}

std::variant<FrameFit, Miss> FrameFitter::Finish(const FrameFit& rough) {
  FrameFit start = rough;
  border_ = FindBorder(views_, start.adjustment.frame, settings_.border);
  if (border_) start.adjustment.frame.border_m = border_->border_m;
  std::optional<FrameFit> fit = FitInOnePlane(start);
  if (!fit && border_) {
    const auto border = border_;
    fit = FitBeforePanes(start);
    if (!fit) border_ = border;
  }
  if (!fit) fit = FitInRelief(start);
  if (fit) fit->front = fit->adjustment.frame;
  // If planes were measured, they and their known offset determine where the front is.
  if (fit && settings_.planes.empty()) SettleDepth(views_, RevealGreyOf(settings_), *fit);
  if (!fit) return Miss{"no_edges", "too few edge points to fix a rectangle"};
  if (fit->LeastSupport() < settings_.min_side_support) {
    return Miss{"unsupported_side",
                fmt::format("only {:.0f} % of a side has an edge, {:.0f} % are needed",
                            100.0 * fit->LeastSupport(), 100.0 * settings_.min_side_support)};
  }
  return *fit;
}

}  // namespace fenestra
