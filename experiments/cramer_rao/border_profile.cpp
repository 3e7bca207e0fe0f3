#include "experiments/cramer_rao/border_profile.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

using Gradient = Eigen::Matrix<double, kBorderUnknowns, 1>;

struct Interval {
  double from;
  double to;
};

Interval BlurOf(const EdgeCrossing& crossing) {
  const double reach = crossing.edge.reach_px() / std::abs(crossing.slant);
  return {crossing.place - reach, crossing.place + reach};
}

BlurredEdge::Value ValueAt(const EdgeCrossing& crossing, int pixel) {
  return crossing.edge.At((pixel - crossing.place) * crossing.slant);
}

// A pixel's information is that of its mean with the gradient g, times this.
double WeightOf(double mean_e, const PixelNoise& noise) {
  if (noise.IsSaturated(mean_e)) return 0.0;
  const double variance = noise.Variance(mean_e);
  const double slope = noise.VarianceSlope(mean_e);
  return 1.0 / variance + 0.5 * slope * slope / (variance * variance);
}

void AddPixel(const BorderLine& line, const BorderLevels& levels, const PixelNoise& noise,
              int pixel, BorderInformation& information) {
  const BlurredEdge::Value outer = ValueAt(line.outer, pixel);
  const BlurredEdge::Value inner =
      line.inner ? ValueAt(*line.inner, pixel) : BlurredEdge::Value{0.0, 0.0, 0.0};
  const double step_in = levels.frame_e - levels.wall_e;
  const double step_on = levels.opening_e - levels.frame_e;
  const double mean_e = levels.wall_e + step_in * outer.share + step_on * inner.share;
  Gradient gradient;
  gradient << -step_in * outer.by_distance, -step_on * inner.by_distance,
      step_in * outer.by_sigma + step_on * inner.by_sigma, 1.0 - outer.share,
      outer.share - inner.share, inner.share;
  information += WeightOf(mean_e, noise) * (gradient * gradient.transpose());
}

// Pixels of the line whose centres are in the interval.
struct Pixels {
  int from;
  int to;  // The last one; less than `from` for none.
};
Pixels Within(const BorderLine& line, const Interval& interval) {
  return {std::max(line.first, static_cast<int>(std::ceil(interval.from))),
          std::min(line.last, static_cast<int>(std::floor(interval.to)))};
}

double LengthInside(const BorderLine& line, double from, double to) {
  return std::max(0.0, std::min(to, line.last + 0.5) - std::max(from, line.first - 0.5));
}

}  // namespace

BorderInformation InformationOf(const BorderLine& line, const BorderLevels& levels,
                                const PixelNoise& noise) {
  BorderInformation information = BorderInformation::Zero();
  const Interval outer = BlurOf(line.outer);
  const Interval inner = line.inner ? BlurOf(*line.inner) : outer;
  const bool joined = line.inner && inner.from <= outer.to && outer.from <= inner.to;
  const auto add = [&](const Interval& interval) {
    const Pixels pixels = Within(line, interval);
    for (int i = pixels.from; i <= pixels.to; ++i) AddPixel(line, levels, noise, i, information);
  };
  if (joined) {
    add({std::min(outer.from, inner.from), std::max(outer.to, inner.to)});
  } else {
    add(outer);
    if (line.inner) add(inner);
  }
  // The rest is flat. Inwards along the line or against it:
  const bool forward = line.outer.slant > 0.0;
  const auto add_flat = [&](int unknown, double level_e, double from, double to) {
    information(unknown, unknown) += LengthInside(line, from, to) * WeightOf(level_e, noise);
  };
  const double margin = line.margin_px;
  add_flat(3, levels.wall_e, forward ? outer.from - margin : outer.to,
           forward ? outer.from : outer.to + margin);
  if (!line.inner) {
    add_flat(4, levels.frame_e, forward ? outer.to : outer.from - margin,
             forward ? outer.to + margin : outer.from);
    return information;
  }
  if (!joined) {
    add_flat(4, levels.frame_e, std::min(outer.to, inner.to), std::max(outer.from, inner.from));
  }
  add_flat(5, levels.opening_e, forward ? inner.to : inner.from - margin,
           forward ? inner.to + margin : inner.from);
  return information;
}

}  // namespace fenestra
