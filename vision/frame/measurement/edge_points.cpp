#include "vision/frame/measurement/edge_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "vision/frame/measurement/edge_nuisance.h"
#include "vision/frame/measurement/side_sampling.h"

namespace fenestra {
namespace {

// Strips whose mean square exceeds this multiple of the side's median show something else.
constexpr double kMostExcess = 9.0;
constexpr double kOwnExcess = 2.0;

double MedianSquare(const std::vector<StepFit>& fits) {
  std::vector<double> squares;
  for (const StepFit& fit : fits) squares.push_back(fit.mean_square);
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return *middle;
}

// Relative change of the light across an edge by vignetting, outwards [1/px].
double Falloff(const CameraModel& camera, const EdgeStrip& strip, const Vignetting& vignetting) {
  const CameraParameters& p = camera.parameters();
  const Eigen::Vector2d focal_px(p.fx_px, p.fy_px);
  const Eigen::Vector2d tangent =
      (strip.pixel - Eigen::Vector2d(p.cx_px, p.cy_px)).cwiseQuotient(focal_px);
  return -vignetting.power * tangent.dot(strip.normal.cwiseQuotient(focal_px)) /
         (1.0 + tangent.squaredNorm());
}

// Normal and vignetting in the middle of a side: the mean of two strips if their number is even, so
// that the result does not depend on the end from which strips are counted.
struct Middle {
  Eigen::Vector2d normal;
  double falloff;
};
Middle MiddleOf(const CameraModel& camera, const std::vector<EdgeStrip>& strips,
                const Vignetting& vignetting) {
  const EdgeStrip& a = strips[(strips.size() - 1) / 2];
  const EdgeStrip& b = strips[strips.size() / 2];
  return {.normal = (a.normal + b.normal).normalized(),
          .falloff = 0.5 * (Falloff(camera, a, vignetting) + Falloff(camera, b, vignetting))};
}

// Strips with an edge, and the fits of their edges.
struct Fitted {
  std::vector<EdgeStrip> strips;
  std::vector<StepFit> fits;
  double median_square = 0.0;
};

Fitted FitAll(const StepModel& model, std::vector<EdgeStrip> strips) {
  Fitted all;
  for (EdgeStrip& strip : strips) {
    if (const auto fit = model.Fit(strip)) {
      all.fits.push_back(*fit);
      all.strips.push_back(std::move(strip));
    }
  }
  if (all.fits.empty()) return all;
  all.median_square = MedianSquare(all.fits);
  Fitted good;
  good.median_square = all.median_square;
  for (size_t i = 0; i < all.fits.size(); ++i) {
    if (all.fits[i].mean_square > kMostExcess * all.median_square) continue;
    good.fits.push_back(all.fits[i]);
    good.strips.push_back(std::move(all.strips[i]));
  }
  return good;
}

}  // namespace

SideEdges MeasureSide(const CameraView& view, const FrameRectangle& frame, const SideRequest& asked,
                      const EdgeNuisance& nuisance) {
  SideRequest request = asked;
  if (!nuisance.is_even) request.far_px = request.reach_px;
  SideEdges edges;
  edges.nuisance = nuisance;
  EdgeStrips cut = CutStrips(view, frame, request);
  edges.places = cut.places;
  if (cut.strips.empty()) return edges;
  const Middle middle = MiddleOf(view.camera, cut.strips, request.vignetting);
  const StepModel model(request, nuisance, middle.normal);
  const Fitted fitted = FitAll(model, std::move(cut.strips));
  if (fitted.fits.empty()) return edges;
  const NuisanceEstimate estimate = EstimateNuisance(
      model, fitted.strips, fitted.fits,
      {.excess = fitted.median_square, .falloff = middle.falloff}, request, nuisance);
  if (!estimate.nuisance.is_even && request.far_px > request.reach_px) {
    EdgeNuisance uneven = nuisance;
    uneven.is_even = false;
    return MeasureSide(view, frame, request, uneven);
  }
  for (size_t i = 0; i < fitted.fits.size(); ++i) {
    const StepFit& fit = fitted.fits[i];
    const EdgeStrip& strip = fitted.strips[i];
    const double scale = fit.mean_square > kOwnExcess * fitted.median_square ? fit.mean_square
                                                                             : fitted.median_square;
    edges.points.push_back(
        {.side = request.side,
         .border = request.border,
         .share = strip.share,
         .normal = strip.normal,
         .pixel = strip.pixel + fit.s0_px * strip.normal,
         .sigma_px = std::sqrt(scale * fit.s0_variance),
         .common_sigma_px = estimate.common_sigma_px,
         .shift_sigma_px = request.shift.SigmaAt(PlaceInImage(view.camera, strip.pixel))});
  }
  edges.nuisance = estimate.nuisance;
  return edges;
}

}  // namespace fenestra
