#include "vision/frame/detection/edge_segments.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/frame/detection/edge_segment.h"
#include "vision/frame/detection/quadrilateral.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr double kCollinear_px = 1.2;
constexpr double kParallel = 0.06;
// Least darkness of a joined segment relative to its less clear part; below that, the gap shows
// something else.
constexpr double kJoinedDarkness = 0.6;
// Largest distance between the ends of one edge found at both scales; along the edge, blur rounds
// off its corners.
constexpr double kSameAcross_px = 1.5;
constexpr double kSameAlong_px = 4.0;

double Weight(const EdgeSegment& s) {
  return s.Length() * s.darkness;
}

void KeepBest(size_t most, std::vector<EdgeSegment>& segments) {
  std::stable_sort(
      segments.begin(), segments.end(),
      [](const EdgeSegment& a, const EdgeSegment& b) { return Weight(a) > Weight(b); });
  if (segments.size() > most) segments.resize(most);
}

bool Continues(const EdgeSegment& a, const EdgeSegment& b) {
  const Vector2d between = b.from - a.to;
  const Vector2d side = a.to - a.from;
  // This test without a square root rejects most pairs.
  if (std::pow(Cross(side, between), 2) >
      0.01 * side.squaredNorm() * between.squaredNorm() + 4.0 * side.squaredNorm()) {
    return false;
  }
  const Vector2d along = side.normalized();
  const double gap = along.dot(between);
  if (gap < -3.0 || gap > 0.5 * (a.Length() + b.Length())) return false;
  const Vector2d whole = (b.to - a.from).normalized();
  return std::abs(Cross(along, (b.to - b.from).normalized())) < kParallel &&
         std::abs(Cross(whole, a.to - a.from)) < kCollinear_px &&
         std::abs(Cross(whole, b.from - a.from)) < kCollinear_px;
}

std::vector<EdgeSegment> Joined(const cv::Mat1b& image, const std::vector<EdgeSegment>& segments,
                                const DarknessSettings& settings) {
  std::vector<EdgeSegment> joined;
  for (const EdgeSegment& a : segments) {
    for (const EdgeSegment& b : segments) {
      if (&a == &b || !Continues(a, b)) continue;
      EdgeSegment both{a.from, b.to, 0.0};
      both.darkness = DarkOnTheRight(image, both.from, both.to, settings);
      if (both.darkness >= kJoinedDarkness * std::min(a.darkness, b.darkness)) {
        joined.push_back(both);
      }
    }
  }
  return joined;
}

// Returns the edges of an image of half the size in pixels of the original, whose pixel u lies at
// 0.5 u - 0.25 in the smaller image.
EdgeSegments FollowCoarseEdges(const cv::Mat1b& image, const EdgeSegmentSettings& settings) {
  const cv::Size size(image.cols / 2, image.rows / 2);
  if (size.empty()) return {};
  cv::Mat1b half;
  cv::resize(image(cv::Rect(cv::Point(), size * 2)), half, size, 0.0, 0.0, cv::INTER_AREA);
  EdgeSegments all = FollowEdges(half, settings);
  const auto whole = [](const Vector2d& p) { return Vector2d(2.0 * p + Vector2d(0.5, 0.5)); };
  for (std::vector<EdgeSegment>& segments : all) {
    for (EdgeSegment& s : segments) s = {whole(s.from), whole(s.to), s.darkness};
  }
  return all;
}

// Rates the segments and keeps the clear ones, the best first.
void KeepClear(const cv::Mat1b& image, const EdgeSegmentSettings& settings, size_t most,
               std::vector<EdgeSegment>& segments) {
  for (EdgeSegment& s : segments) {
    s.darkness = DarkOnTheRight(image, s.from, s.to, settings.darkness);
  }
  std::erase_if(segments, [&](const EdgeSegment& s) { return s.darkness < settings.min_darkness; });
  KeepBest(most, segments);
}

bool IsSame(const EdgeSegment& a, const EdgeSegment& b) {
  const Vector2d along = (a.to - a.from).normalized();
  const Vector2d off_from = b.from - a.from;
  const Vector2d off_to = b.to - a.to;
  return std::abs(along.dot(off_from)) < kSameAlong_px &&
         std::abs(along.dot(off_to)) < kSameAlong_px &&
         std::abs(Cross(along, off_from)) < kSameAcross_px &&
         std::abs(Cross(along, off_to)) < kSameAcross_px;
}

void AddNew(const std::vector<EdgeSegment>& more, std::vector<EdgeSegment>& segments) {
  const size_t known = segments.size();
  for (const EdgeSegment& s : more) {
    const auto end = segments.begin() + static_cast<std::ptrdiff_t>(known);
    const bool is_known = std::any_of(segments.begin(), end,
                                      [&](const EdgeSegment& other) { return IsSame(other, s); });
    if (!is_known) segments.push_back(s);
  }
}

}  // namespace

EdgeSegments FindEdgeSegments(const cv::Mat1b& image, const EdgeSegmentSettings& settings) {
  const auto most = static_cast<size_t>(settings.most_per_side);
  EdgeSegments all = FollowEdges(image, settings);
  EdgeSegments coarse = FollowCoarseEdges(image, settings);
  for (size_t side = 0; side < all.size(); ++side) {
    std::vector<EdgeSegment>& segments = all[side];
    KeepClear(image, settings, most, segments);
    std::vector<EdgeSegment> joined = Joined(image, segments, settings.darkness);
    KeepBest(most / 4, joined);
    segments.insert(segments.end(), joined.begin(), joined.end());
    KeepClear(image, settings, most / 4, coarse[side]);
    AddNew(coarse[side], segments);
  }
  return all;
}

Vector2d Meet(const EdgeSegment& a, const EdgeSegment& b) {
  const Vector2d p = a.to - a.from;
  const Vector2d q = b.to - b.from;
  const double area = Cross(p, q);
  if (std::abs(area) < 1e-6 * p.norm() * q.norm()) return Vector2d::Constant(1e9);
  return a.from + Cross(b.from - a.from, q) / area * p;
}

}  // namespace fenestra
