#include "vision/stereo/frame_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

constexpr int kRounds = 4;
constexpr double kLeastReach_px = 1.6;
// Of the places along the inner sides; with fewer the border is left out.
constexpr double kLeastInnerSupport = 0.5;

// Width of the border in the image, where it is narrowest.
double BorderPixels(const CameraView& view, const FrameRectangle& frame) {
  double least = 1e9;
  for (const Side side : kAllSides) {
    const auto outer = view.camera.Project(view.X_CL * frame.PointOn(side, Border::kOuter, 0.5));
    const auto inner = view.camera.Project(view.X_CL * frame.PointOn(side, Border::kInner, 0.5));
    if (outer && inner) least = std::min(least, (*outer - *inner).norm());
  }
  return least;
}

class FitRounds {
 public:
  FitRounds(const std::array<CameraView, 2>& views, const FrameFitSettings& settings)
      : views_(views), settings_(settings) {}

  std::optional<FrameFit> Round(const FrameRectangle& frame,
                                const std::optional<BorderFound>& border) {
    FrameFit fit;
    std::array<std::array<int, 4>, 2> outer_places = {};
    int inner_places = 0;
    for (size_t view = 0; view < 2; ++view) {
      const double reach_px = border ? std::clamp(0.5 * BorderPixels(views_[view], frame),
                                                  kLeastReach_px, settings_.reach_px)
                                     : settings_.reach_px;
      for (const Side side : kAllSides) {
        const auto s = static_cast<size_t>(side);
        outer_places[view][s] = Measure(view, frame,
                                        {.side = side,
                                         .border = Border::kOuter,
                                         .brighter = Brighter::kOutside,
                                         .reach_px = reach_px,
                                         .min_contrast_dn = settings_.min_contrast_dn},
                                        fit.points[view]);
        if (!border) continue;
        inner_places += Measure(view, frame,
                                {.side = side,
                                 .border = Border::kInner,
                                 .brighter = border->brighter[s],
                                 .reach_px = reach_px,
                                 .min_contrast_dn = settings_.min_contrast_dn},
                                fit.points[view]);
      }
    }
    auto adjustment = AdjustFrame(views_, fit.points, frame, settings_.prior);
    if (!adjustment) return std::nullopt;
    fit.adjustment = std::move(*adjustment);
    CountSupport(outer_places, inner_places, fit);
    return fit;
  }

 private:
  int Measure(size_t view, const FrameRectangle& frame, const SideRequest& request,
              std::vector<EdgePoint>& points) {
    EdgeTuning& tuning =
        tunings_[view][static_cast<size_t>(request.border)][static_cast<size_t>(request.side)];
    SideEdges edges = MeasureSide(views_[view], frame, request, tuning);
    points.insert(points.end(), edges.points.begin(), edges.points.end());
    tuning = edges.tuning;
    return edges.places;
  }

  static void CountSupport(const std::array<std::array<int, 4>, 2>& outer_places, int inner_places,
                           FrameFit& fit) {
    double inner = 0.0;
    for (size_t view = 0; view < 2; ++view) {
      std::array<double, 4> outer = {};
      for (size_t i = 0; i < fit.points[view].size(); ++i) {
        if (fit.adjustment.weights[view][i] <= 0.0) continue;
        const EdgePoint& point = fit.points[view][i];
        (point.border == Border::kOuter ? outer[static_cast<size_t>(point.side)] : inner) += 1.0;
      }
      for (size_t side = 0; side < 4; ++side) {
        if (outer_places[view][side] == 0) continue;
        fit.outer_support[side] =
            std::max(fit.outer_support[side], outer[side] / outer_places[view][side]);
      }
    }
    if (inner_places > 0) fit.inner_support = inner / inner_places;
  }

  const std::array<CameraView, 2>& views_;
  const FrameFitSettings& settings_;
  std::array<std::array<std::array<EdgeTuning, 4>, 2>, 2> tunings_;
};

}  // namespace

std::variant<FrameFit, Miss> FitFrame(const std::array<CameraView, 2>& views,
                                      const FrameRectangle& start,
                                      const FrameFitSettings& settings) {
  FitRounds rounds(views, settings);
  FrameRectangle frame = start;
  std::optional<BorderFound> border;
  std::optional<FrameFit> fit;
  for (int i = 0; i < kRounds; ++i) {
    fit = rounds.Round(frame, border);
    if (!fit) return Miss{"no_edges", "too few edge points to fix a rectangle"};
    frame = fit->adjustment.frame;
    if (border && fit->inner_support < kLeastInnerSupport) border.reset();
    if (i == 0) {
      border = FindBorder(views[0], frame, settings.border);
      if (border) frame.border_m = border->border_m;
    }
  }
  const double least = *std::min_element(fit->outer_support.begin(), fit->outer_support.end());
  if (least < settings.min_side_support) {
    return Miss{"unsupported_side",
                fmt::format("only {:.0f} % of a side has an edge, {:.0f} % are needed",
                            100.0 * least, 100.0 * settings.min_side_support)};
  }
  return *fit;
}

}  // namespace fenestra
