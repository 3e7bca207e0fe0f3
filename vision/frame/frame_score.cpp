#include "vision/frame/frame_score.h"

#include <fmt/format.h>

#include "vision/frame/measurement/frame_border.h"

namespace fenestra {
namespace {

// Factor on the score of a frame whose sides do not lie in one plane.
constexpr double kNotFlat = 0.85;

double ClarityIn(const CameraView& view, const FrameRectangle& frame,
                 const DarknessSettings& settings) {
  constexpr int kPieces = 4;
  double sum = 0.0;
  for (const Side side : kAllSides) {
    for (int i = 0; i < kPieces; ++i) {
      const auto from = view.camera.Project(
          view.X_CL * frame.PointOn(side, Border::kOuter, i / static_cast<double>(kPieces)));
      const auto to = view.camera.Project(
          view.X_CL * frame.PointOn(side, Border::kOuter, (i + 1) / static_cast<double>(kPieces)));
      if (from && to) sum += DarkOnTheRight(view.image, *from, *to, settings);
    }
  }
  return sum / (4 * kPieces);
}

double GreyRatioIn(const CameraView& view, const FrameRectangle& frame,
                   const DarknessSettings& settings) {
  constexpr int kPieces = 4;
  std::vector<Eigen::Vector2d> outline;
  for (const Side side : kAllSides) {
    for (int i = 0; i < kPieces; ++i) {
      const auto pixel = view.camera.Project(
          view.X_CL * frame.PointOn(side, Border::kOuter, i / static_cast<double>(kPieces)));
      if (pixel) outline.push_back(*pixel);
    }
  }
  return DarkOverBright(view.image, outline, settings);
}

// Mean of `of` over the views.
template <typename Of>
double Mean(std::span<const CameraView> views, Of of) {
  double sum = 0.0;
  for (const CameraView& view : views) sum += of(view);
  return sum / static_cast<double>(views.size());
}

}  // namespace

double FrameClarity(std::span<const CameraView> views, const FrameRectangle& frame,
                    const DarknessSettings& settings) {
  return Mean(views, [&](const CameraView& view) { return ClarityIn(view, frame, settings); });
}

double FrameGreyRatio(std::span<const CameraView> views, const FrameRectangle& frame,
                      const DarknessSettings& settings) {
  return Mean(views, [&](const CameraView& view) { return GreyRatioIn(view, frame, settings); });
}

double FrameScore(std::span<const CameraView> views, const FrameFit& fit,
                  const DarknessSettings& settings) {
  const FrameRectangle& frame = fit.adjustment.frame;
  const double seen = 0.4 * FrameClarity(views, frame, settings) + 0.4 * fit.MeanSupport() +
                      0.2 * fit.inner_support;
  return seen * (fit.is_flat ? 1.0 : kNotFlat) *
         (1.0 - 0.6 * BrightBand(views, frame, settings.black_dn));
}

std::optional<Miss> ObjectionToClarity(std::span<const CameraView> views,
                                       const FrameRectangle& frame,
                                       const DarknessSettings& settings, double min_clarity) {
  const double clarity = FrameClarity(views, frame, settings);
  if (!(clarity < min_clarity)) return std::nullopt;
  return Miss{"not_dark", fmt::format("the fitted frame is darker than its surroundings by "
                                      "{:.2f}, {:.2f} are needed",
                                      clarity, min_clarity)};
}

WindowEstimate EstimateOf(std::span<const CameraView> views, const FrameFit& fit,
                          double rough_score, const DarknessSettings& settings) {
  WindowEstimate estimate = fit.front.ToEstimate();
  estimate.covariance_C = fit.adjustment.covariance.block<3, 3>(3, 3);
  estimate.score = 0.5 * (rough_score + FrameScore(views, fit, settings));
  return estimate;
}

}  // namespace fenestra
