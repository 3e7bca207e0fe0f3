#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "core/detection.h"
#include "vision/frame/frame_border.h"
#include "vision/frame/frame_fit.h"
#include "vision/frame/frame_knowledge.h"

namespace fenestra {

struct FrameFitSettings {
  double min_contrast_dn;
  double reach_px = 4.0;  ///< Pixels up to here from an edge are used, unless another is nearer.
  /// The reach away from the border, once the rectangle is known well. Where light is even, the
  /// level of the grey values beside an edge is told well enough so far from it.
  double far_px = 8.0;
  double min_side_support;  ///< Share of an outer side's places with its edge.
  BorderSearch border;
  std::optional<SizePrior> size;  ///< Used in the last adjustment only.
  std::vector<PlaneMeasurement> planes{};
  Vignetting vignetting;
};

/// From a rectangle that is right to some pixels to the one that fits best: measures the sides in
/// all views and adjusts the rectangle to them, in rounds.
class FrameFitter {
 public:
  /// The views must outlive this.
  FrameFitter(std::span<const CameraView> views, const FrameFitSettings& settings)
      : views_(views), settings_(settings), tunings_(views.size()) {}

  /// From now on these instead of those in the settings.
  void UsePlanes(std::vector<PlaneMeasurement> planes) { settings_.planes = std::move(planes); }

  /// One round with the outer sides alone. nullopt if they fix no rectangle.
  std::optional<FrameFit> FitRoughly(const FrameRectangle& start);

  /// Looks for the border's inner edge and goes on with both, in the first of these ways that the
  /// edges bear out:
  ///
  ///   1. all sides in one plane: a painted or a flush frame;
  ///   2. the outer sides in one plane, the inner ones in another;
  ///   3. each outer side with a relief of its own: the wall's face here, a sill or the frame
  ///   there;
  ///   4. all in one plane, but only to 0.7 px.
  ///
  /// Then, by what two views show, how far the frame's front is behind that: frame_depth.h. With
  /// planes that were measured otherwise all that is left alone.
  ///
  /// Miss: "no_edges", "unsupported_side".
  std::variant<FrameFit, Miss> Finish(const FrameFit& rough);

 private:
  std::optional<FrameFit> Round(const FrameRectangle& frame, const FrameKnowledge& knowledge,
                                double tolerance_px, bool is_last);
  std::optional<FrameFit> FitInOnePlane(const FrameFit& start);
  std::optional<FrameFit> FitBeforePanes(const FrameFit& start);
  std::optional<FrameFit> FitInRelief(const FrameFit& start);
  std::optional<FrameFit> Rounds(FrameFit fit, const FrameKnowledge& knowledge,
                                 std::span<const double> tolerances_px);
  int Measure(size_t view, const FrameRectangle& frame, const SideRequest& request,
              std::vector<EdgePoint>& points);

  std::span<const CameraView> views_;
  FrameFitSettings settings_;
  std::optional<BorderFound> border_;
  std::vector<std::array<std::array<EdgeTuning, 4>, 2>> tunings_;  // View, border, side.
};

}  // namespace fenestra
