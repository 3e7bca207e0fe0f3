#include "vision/stereo/frame_seed.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeastCommonRows = 0.4;
constexpr double kLeastClarity = 0.3;  // Of that in the left image.
// Of the depth: corners that are so near are the same.
constexpr double kSame = 0.012;

// Disparities of a side's upper and lower end.
struct SideDisparity {
  double upper_px;
  double lower_px;
};

double ColumnAt(const EdgeSegment& s, double v) {
  return s.from.x() + (v - s.from.y()) / (s.to.y() - s.from.y()) * (s.to.x() - s.from.x());
}

std::vector<SideDisparity> Matches(const Vector2d& upper, const Vector2d& lower,
                                   const std::vector<EdgeSegment>& candidates, double smallest_px,
                                   double largest_px) {
  std::vector<SideDisparity> matches;
  for (const EdgeSegment& s : candidates) {
    const double first = std::min(s.from.y(), s.to.y());
    const double last = std::max(s.from.y(), s.to.y());
    const double common = std::min(last, lower.y()) - std::max(first, upper.y());
    if (common < kLeastCommonRows * std::min(last - first, lower.y() - upper.y())) continue;
    if (common < 0.25 * (lower.y() - upper.y())) continue;
    const SideDisparity d{upper.x() - ColumnAt(s, upper.y()), lower.x() - ColumnAt(s, lower.y())};
    if (std::min(d.upper_px, d.lower_px) < smallest_px) continue;
    if (std::max(d.upper_px, d.lower_px) > largest_px) continue;
    matches.push_back(d);
  }
  return matches;
}

bool NearlySame(const FrameSeed& a, const FrameSeed& b) {
  for (size_t i = 0; i < 4; ++i) {
    if ((a.p_FV[i] - b.p_FV[i]).norm() > kSame * a.p_FV[i].z()) return false;
  }
  return true;
}

}  // namespace

std::vector<FrameSeed> FindSeeds(const DarkQuadrilateral& left, const EdgeSegments& right_segments,
                                 const cv::Mat1b& right_image, const RectifiedCamera& camera,
                                 const FrameLimits& limits, const DarknessSettings& darkness) {
  const Quadrilateral& q = left.corners_px;
  const double smallest_px = camera.DisparityFromDepth(limits.farthest_m);
  const double largest_px = camera.DisparityFromDepth(limits.nearest_m);
  const auto lefts = Matches(q[0], q[3], right_segments[static_cast<size_t>(Side::kLeft)],
                             smallest_px, largest_px);
  const auto rights = Matches(q[1], q[2], right_segments[static_cast<size_t>(Side::kRight)],
                              smallest_px, largest_px);
  std::vector<FrameSeed> seeds;
  for (const SideDisparity& l : lefts) {
    for (const SideDisparity& r : rights) {
      const std::array<double, 4> d = {l.upper_px, r.upper_px, r.lower_px, l.lower_px};
      FrameSeed seed;
      Quadrilateral right;
      for (size_t i = 0; i < 4; ++i) {
        seed.p_FV[i] = camera.DepthFromDisparity(d[i]) * camera.Ray(q[i]);
        right[i] = q[i] - Vector2d(d[i], 0.0);
      }
      if (!AreCornersOfFrame(seed.p_FV, limits)) continue;
      const double clarity = DarkInside(right_image, right, darkness);
      if (clarity < kLeastClarity * left.clarity) continue;
      if (!IsDarkThroughout(right_image, right, darkness)) continue;
      seed.clarity = 0.5 * (left.clarity + clarity);
      seeds.push_back(seed);
    }
  }
  return seeds;
}

std::vector<FrameSeed> ClearestSeeds(std::vector<FrameSeed> seeds, size_t most) {
  std::stable_sort(seeds.begin(), seeds.end(),
                   [](const FrameSeed& a, const FrameSeed& b) { return a.clarity > b.clarity; });
  std::vector<FrameSeed> kept;
  for (const FrameSeed& seed : seeds) {
    if (kept.size() == most) break;
    const bool known = std::any_of(kept.begin(), kept.end(),
                                   [&](const FrameSeed& other) { return NearlySame(seed, other); });
    if (!known) kept.push_back(seed);
  }
  return kept;
}

}  // namespace fenestra
