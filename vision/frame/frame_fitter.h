#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "core/detection/detection.h"
#include "vision/frame/adjustment/frame_fit.h"
#include "vision/frame/measurement/frame_border.h"
#include "vision/frame/model/frame_prior.h"

namespace fenestra {

struct FrameFitSettings {
  double min_contrast_dn;
  double reach_px = 4.0;  ///< Pixels up to here from an edge are used, unless another is nearer.
  /// The reach on the side away from the border, once the rectangle is known well. In even light
  /// this is far enough to determine the level of the grey values beside an edge.
  double far_px = 8.0;
  double min_side_support;  ///< Least share of an outer side's places at which its edge is found.
  BorderSearch border;
  std::optional<SizePrior> size;  ///< Used only in the last adjustment.
  std::vector<PlaneMeasurement> planes{};
  Vignetting vignetting;
  EdgeShift shift{};
};

/// Refines a rectangle that is accurate to a few pixels: measures its sides in all views and
/// adjusts the rectangle to them, in rounds.
class FrameFitter {
 public:
  /// The views must outlive the fitter.
  FrameFitter(std::span<const CameraView> views, const FrameFitSettings& settings)
      : views_(views), settings_(settings), nuisances_(views.size()) {}

  /// Replaces the planes given in the settings.
  void UsePlanes(std::vector<PlaneMeasurement> planes) { settings_.planes = std::move(planes); }

  /// Does one round with the outer sides alone. Returns nullopt if they do not determine a
  /// rectangle.
  std::optional<FrameFit> FitRoughly(const FrameRectangle& start);

  /// Finds the inner edge of the border and fits both edges with the first of these models that
  /// agrees with them:
  ///
  ///   1. all sides in one plane: a painted or a flush frame;
  ///   2. the outer sides in one plane, the inner ones in another;
  ///   3. each outer side with a relief of its own, such as the wall's face or a sill;
  ///   4. all in one plane, but only to 0.7 px.
  ///
  /// It then estimates how far the frame's front is behind the fitted rectangle, by the parallax
  /// between two views (settle_depth.h), unless planes were measured by other means.
  ///
  /// Miss: "no_edges", "unsupported_side".
  std::variant<FrameFit, Miss> Finish(const FrameFit& rough);

 private:
  /// The edge points of all sides in one view, and the numbers of places at which they were sought.
  struct ViewEdges {
    std::vector<EdgePoint> points;
    SideCounts outer_places = {};
    SideCounts inner_places = {};
  };
  std::optional<FrameFit> Round(const FrameRectangle& frame, const FramePrior& prior,
                                double tolerance_px, bool is_last);
  std::optional<FrameFit> FitInOnePlane(const FrameFit& start);
  std::optional<FrameFit> FitBeforePanes(const FrameFit& start);
  std::optional<FrameFit> FitInRelief(const FrameFit& start);
  std::optional<FrameFit> Rounds(FrameFit fit, const FramePrior& prior,
                                 std::span<const double> tolerances_px);
  ViewEdges MeasureView(size_t view, const FrameRectangle& frame, double tolerance_px,
                        bool is_last);
  SideEdges Measure(size_t view, const FrameRectangle& frame, const SideRequest& request);

  std::span<const CameraView> views_;
  FrameFitSettings settings_;
  std::optional<BorderFound> border_;
  std::vector<std::array<std::array<EdgeNuisance, 4>, 2>> nuisances_;  // View, border, side.
};

}  // namespace fenestra
