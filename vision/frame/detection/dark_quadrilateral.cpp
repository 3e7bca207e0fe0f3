#include "vision/frame/detection/dark_quadrilateral.h"

#include <algorithm>
#include <bitset>
#include <cmath>

#include "vision/frame/detection/edge_segments.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr size_t kMostSegments = 256;
constexpr double kCornerReach_px = 6.0;
constexpr double kCornerShare = 0.25;
constexpr double kLeastSine = 0.4;  // Least sine of a corner's angle: 24°.

using SegmentSet = std::bitset<kMostSegments>;

double Reach(const EdgeSegment& s) {
  return std::max(kCornerReach_px, kCornerShare * s.Length());
}

// Distance of a point on a segment's line beyond the ends of the segment.
double Beyond(const EdgeSegment& s, const Vector2d& point) {
  const Vector2d along = (s.to - s.from).normalized();
  return std::max(along.dot(s.from - point), along.dot(point - s.to));
}

// Tells whether a vertical side ends where it meets a horizontal one. The horizontal one may
// continue, as joints and lintels in line with the frame do.
bool MakeCorner(const EdgeSegment& upright, const Vector2d& end, const EdgeSegment& level) {
  const Vector2d p = (upright.to - upright.from).normalized();
  const Vector2d q = (level.to - level.from).normalized();
  if (std::abs(Cross(p, q)) < kLeastSine) return false;
  const Vector2d corner = Meet(upright, level);
  return (corner - end).norm() <= Reach(upright) && Beyond(level, corner) <= Reach(level);
}

// The horizontal segments that each vertical one meets at this end.
std::vector<SegmentSet> Corners(const std::vector<EdgeSegment>& uprights,
                                Vector2d EdgeSegment::*end,
                                const std::vector<EdgeSegment>& levels) {
  std::vector<SegmentSet> sets(uprights.size());
  for (size_t i = 0; i < uprights.size(); ++i) {
    for (size_t j = 0; j < std::min(kMostSegments, levels.size()); ++j) {
      sets[i][j] = MakeCorner(uprights[i], uprights[i].*end, levels[j]);
    }
  }
  return sets;
}

// DarkInside, or 0 as soon as one side is not dark enough.
double Clarity(const cv::Mat1b& image, const Quadrilateral& q, const DarknessSettings& settings,
               double least) {
  double sum = 0.0;
  for (const size_t i : {3, 1, 0, 2}) {
    const double clarity = DarkOnTheRight(image, q[i], q[(i + 1) % 4], settings);
    if (clarity < least) return 0.0;
    sum += clarity;
  }
  return 0.25 * sum;
}

bool NearlySame(const Quadrilateral& a, const Quadrilateral& b) {
  for (size_t i = 0; i < 4; ++i) {
    if ((a[i] - b[i]).lpNorm<Eigen::Infinity>() > 2.5) return false;
  }
  return true;
}

}  // namespace

std::vector<DarkQuadrilateral> FindDarkQuadrilaterals(const cv::Mat1b& image,
                                                      const EdgeSegments& segments,
                                                      const DarknessSettings& settings,
                                                      double min_darkness, size_t most) {
  const auto& [tops, rights, bottoms, lefts] = segments;
  const auto tops_of_lefts = Corners(lefts, &EdgeSegment::to, tops);
  const auto bottoms_of_lefts = Corners(lefts, &EdgeSegment::from, bottoms);
  const auto tops_of_rights = Corners(rights, &EdgeSegment::from, tops);
  const auto bottoms_of_rights = Corners(rights, &EdgeSegment::to, bottoms);
  std::vector<DarkQuadrilateral> found;
  for (size_t l = 0; l < lefts.size(); ++l) {
    for (size_t r = 0; r < rights.size(); ++r) {
      const SegmentSet common_tops = tops_of_lefts[l] & tops_of_rights[r];
      const SegmentSet common_bottoms = bottoms_of_lefts[l] & bottoms_of_rights[r];
      if (common_tops.none() || common_bottoms.none()) continue;
      for (size_t t = 0; t < tops.size(); ++t) {
        if (!common_tops[t]) continue;
        for (size_t b = 0; b < bottoms.size(); ++b) {
          if (!common_bottoms[b]) continue;
          const Quadrilateral q = {Meet(lefts[l], tops[t]), Meet(tops[t], rights[r]),
                                   Meet(rights[r], bottoms[b]), Meet(bottoms[b], lefts[l])};
          if (!IsConvex(q)) continue;
          const double clarity = Clarity(image, q, settings, min_darkness);
          if (clarity <= 0.0 || !IsDarkThroughout(image, q, settings)) continue;
          const double length_px =
              (lefts[l].Length() + rights[r].Length()) + (tops[t].Length() + bottoms[b].Length());
          found.push_back({q, clarity, length_px});
        }
      }
    }
  }
  std::stable_sort(found.begin(), found.end(), IsClearer<DarkQuadrilateral>);
  std::vector<DarkQuadrilateral> kept;
  for (const DarkQuadrilateral& candidate : found) {
    if (kept.size() == most) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const DarkQuadrilateral& other) {
      return NearlySame(candidate.corners_px, other.corners_px);
    });
    if (!known) kept.push_back(candidate);
  }
  return kept;
}

}  // namespace fenestra
