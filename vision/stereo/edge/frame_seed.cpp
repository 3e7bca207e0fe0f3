#include "vision/stereo/edge/frame_seed.h"

#include <algorithm>
#include <cmath>

#include "vision/frame/detection/edge_segments.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeastCommonRows = 0.4;
constexpr double kLeastClarity = 0.3;  // Relative to that in the left image.
// Corners closer than this share of their depth are the same.
constexpr double kSame = 0.012;

// Horizontal sides have the same rows in both views, within their accuracy.
constexpr double kSameRow_px = 1.5;
constexpr double kLeastCommonColumns = 0.25;  // Share of a horizontal side.

double ColumnAt(const EdgeSegment& s, double v) {
  return s.from.x() + (v - s.from.y()) / (s.to.y() - s.from.y()) * (s.to.x() - s.from.x());
}

double RowAt(const EdgeSegment& s, double u) {
  return s.from.y() + (u - s.from.x()) / (s.to.x() - s.from.x()) * (s.to.y() - s.from.y());
}

struct DisparityRange {
  double smallest_px;
  double largest_px;
};

std::vector<const EdgeSegment*> UprightMatches(const Vector2d& upper, const Vector2d& lower,
                                               const std::vector<EdgeSegment>& candidates,
                                               const DisparityRange& range) {
  std::vector<const EdgeSegment*> matches;
  for (const EdgeSegment& s : candidates) {
    const double first = std::min(s.from.y(), s.to.y());
    const double last = std::max(s.from.y(), s.to.y());
    const double common = std::min(last, lower.y()) - std::max(first, upper.y());
    if (common < kLeastCommonRows * std::min(last - first, lower.y() - upper.y())) continue;
    if (common < 0.25 * (lower.y() - upper.y())) continue;
    const double upper_px = upper.x() - ColumnAt(s, upper.y());
    const double lower_px = lower.x() - ColumnAt(s, lower.y());
    if (std::min(upper_px, lower_px) < range.smallest_px) continue;
    if (std::max(upper_px, lower_px) > range.largest_px) continue;
    matches.push_back(&s);
  }
  return matches;
}

// Contains only nullptr if there is none.
std::vector<const EdgeSegment*> LevelMatches(const Vector2d& left, const Vector2d& right,
                                             const std::vector<EdgeSegment>& candidates) {
  std::vector<const EdgeSegment*> matches;
  for (const EdgeSegment& s : candidates) {
    const double first = std::min(s.from.x(), s.to.x());
    const double last = std::max(s.from.x(), s.to.x());
    const double common = std::min(last, right.x()) - std::max(first, left.x());
    if (common < kLeastCommonColumns * (right.x() - left.x())) continue;
    if (std::abs(RowAt(s, left.x()) - left.y()) > kSameRow_px) continue;
    if (std::abs(RowAt(s, right.x()) - right.y()) > kSameRow_px) continue;
    matches.push_back(&s);
  }
  if (matches.empty()) matches.push_back(nullptr);
  return matches;
}

double LengthOf(const EdgeSegment* s) {
  return s == nullptr ? 0.0 : s->Length();
}

// The chosen edges of the right image for each side; nullptr for a horizontal side without one.
using RightEdges = std::array<const EdgeSegment*, 4>;

Quadrilateral RightCorners(const Quadrilateral& left, const RightEdges& edges) {
  Quadrilateral corners;
  for (size_t i = 0; i < 4; ++i) {
    const EdgeSegment& upright = *edges[i == 0 || i == 3 ? 3 : 1];
    const EdgeSegment* level = edges[i < 2 ? 0 : 2];
    corners[i] = level == nullptr ? Vector2d(ColumnAt(upright, left[i].y()), left[i].y())
                                  : Meet(upright, *level);
  }
  return corners;
}

FrameSeed SeedOf(const Quadrilateral& left, const Quadrilateral& right,
                 const RectifiedCamera& camera) {
  FrameSeed seed;
  for (size_t i = 0; i < 4; ++i) {
    const size_t other = 3 - i;  // The other end of the vertical side.
    const double v = 0.5 * (left[i].y() + right[i].y());
    const double u_left = ColumnAt({left[i], left[other], 0.0}, v);
    const double disparity_px = u_left - ColumnAt({right[i], right[other], 0.0}, v);
    seed.p_FV[i] = camera.DepthFromDisparity(disparity_px) * camera.Ray({u_left, v});
  }
  return seed;
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
  const auto& [tops, rights, bottoms, lefts] = right_segments;
  const DisparityRange range{camera.DisparityFromDepth(limits.farthest_m),
                             camera.DisparityFromDepth(limits.nearest_m)};
  std::vector<FrameSeed> seeds;
  const auto consider = [&](const RightEdges& edges) {
    const Quadrilateral right = RightCorners(q, edges);
    FrameSeed seed = SeedOf(q, right, camera);
    if (!AreCornersOfFrame(seed.p_FV, limits)) return;
    const double clarity = DarkInside(right_image, right, darkness);
    if (clarity < kLeastClarity * left.clarity) return;
    if (!IsDarkThroughout(right_image, right, darkness)) return;
    seed.clarity = 0.5 * (left.clarity + clarity);
    seed.length_px = left.length_px + ((LengthOf(edges[3]) + LengthOf(edges[1])) +
                                       (LengthOf(edges[0]) + LengthOf(edges[2])));
    seeds.push_back(seed);
  };
  const auto left_matches = UprightMatches(q[0], q[3], lefts, range);
  const auto right_matches = UprightMatches(q[1], q[2], rights, range);
  for (const EdgeSegment* l : left_matches) {
    for (const EdgeSegment* r : right_matches) {
      const Quadrilateral level = RightCorners(q, {nullptr, r, nullptr, l});
      const auto bottom_matches = LevelMatches(level[3], level[2], bottoms);
      for (const EdgeSegment* t : LevelMatches(level[0], level[1], tops)) {
        for (const EdgeSegment* b : bottom_matches) consider({t, r, b, l});
      }
    }
  }
  return seeds;
}

std::vector<FrameSeed> ClearestSeeds(std::vector<FrameSeed> seeds, size_t most) {
  std::stable_sort(seeds.begin(), seeds.end(), IsClearer<FrameSeed>);
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
