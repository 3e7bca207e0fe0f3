#include "vision/frame/adjustment/frame_fit.h"

#include <algorithm>
#include <numeric>

namespace fenestra {
namespace {

void KeepBetter(const SideCounts& found, const SideCounts& places, std::array<double, 4>& support) {
  for (size_t side = 0; side < 4; ++side) {
    if (places[side] == 0) continue;
    support[side] = std::max(support[side], found[side] / static_cast<double>(places[side]));
  }
}

}  // namespace

void CountSupport(const PlaceCounts& places, FrameFit& fit) {
  int inner_places = 0;
  int inner_found = 0;
  for (size_t view = 0; view < fit.points.size(); ++view) {
    SideCounts outer = {};
    SideCounts inner = {};
    for (size_t i = 0; i < fit.points[view].size(); ++i) {
      if (!fit.adjustment.is_inlier[view][i]) continue;
      const EdgePoint& point = fit.points[view][i];
      ++(point.border == Border::kOuter ? outer : inner)[static_cast<size_t>(point.side)];
    }
    KeepBetter(outer, places.outer[view], fit.outer_support);
    KeepBetter(inner, places.inner[view], fit.inner_supports);
    inner_places =
        std::accumulate(places.inner[view].begin(), places.inner[view].end(), inner_places);
    inner_found = std::accumulate(inner.begin(), inner.end(), inner_found);
  }
  if (inner_places > 0) fit.inner_support = inner_found / static_cast<double>(inner_places);
}

double FrameFit::LeastSupport() const {
  return *std::min_element(outer_support.begin(), outer_support.end());
}

double FrameFit::LeastInnerSupport() const {
  return *std::min_element(inner_supports.begin(), inner_supports.end());
}

double FrameFit::MeanSupport() const {
  return std::accumulate(outer_support.begin(), outer_support.end(), 0.0) / 4.0;
}

}  // namespace fenestra
