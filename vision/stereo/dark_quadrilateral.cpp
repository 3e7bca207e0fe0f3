#include "vision/stereo/dark_quadrilateral.h"

#include <algorithm>
#include <bitset>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr int kPlaces = 16;         // Along each side.
constexpr double kEndShare = 0.06;  // Left out at each end of a side.
constexpr size_t kMostSegments = 256;
constexpr double kCornerReach_px = 6.0;
constexpr double kCornerShare = 0.25;
constexpr double kLeastSine = 0.4;  // Of the angle at a corner: 24°.
const double kFullContrast = std::log(4.0);

using SegmentSet = std::bitset<kMostSegments>;

double Cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Whether one side ends where the next one begins.
bool MakeCorner(const EdgeSegment& side, const EdgeSegment& next) {
  const Vector2d p = (side.to - side.from).normalized();
  const Vector2d q = (next.to - next.from).normalized();
  if (Cross(p, q) < kLeastSine) return false;
  const Vector2d corner = Meet(side, next);
  return (corner - side.to).norm() <= std::max(kCornerReach_px, kCornerShare * side.Length()) &&
         (corner - next.from).norm() <= std::max(kCornerReach_px, kCornerShare * next.Length());
}

std::vector<SegmentSet> Corners(const std::vector<EdgeSegment>& sides,
                                const std::vector<EdgeSegment>& partners, bool partner_is_next) {
  std::vector<SegmentSet> sets(sides.size());
  for (size_t i = 0; i < sides.size(); ++i) {
    for (size_t j = 0; j < std::min(kMostSegments, partners.size()); ++j) {
      sets[i][j] =
          partner_is_next ? MakeCorner(sides[i], partners[j]) : MakeCorner(partners[j], sides[i]);
    }
  }
  return sets;
}

bool IsConvex(const Quadrilateral& q) {
  for (size_t i = 0; i < 4; ++i) {
    const Vector2d& p = q[(i + 1) % 4];
    if (Cross(p - q[i], q[(i + 2) % 4] - p) <= 0.0) return false;
  }
  return true;
}

// Grey value in the middle of three places along a ray from an edge; -1 outside the image.
double Grey(const cv::Mat1b& image, const Vector2d& p) {
  const int u = static_cast<int>(std::lround(p.x()));
  const int v = static_cast<int>(std::lround(p.y()));
  if (u < 0 || v < 0 || u >= image.cols || v >= image.rows) return -1.0;
  return image(v, u);
}

double Contrast(const cv::Mat1b& image, const Vector2d& p, const Vector2d& inwards,
                const DarknessSettings& settings) {
  const double near = 0.5 * settings.reach_px;
  const double far = settings.reach_px;
  const double in_a = Grey(image, p + near * inwards);
  const double in_b = Grey(image, p + far * inwards);
  const double out_a = Grey(image, p - near * inwards);
  const double out_b = Grey(image, p - far * inwards);
  if (std::min({in_a, in_b, out_a, out_b}) < 0.0) return 0.0;
  const double inside = 0.5 * (in_a + in_b) - settings.black_dn;
  const double outside = 0.5 * (out_a + out_b) - settings.black_dn;
  if (outside - inside < 3.0 * settings.noise_dn) return 0.0;
  return std::min(1.0, std::log(outside / std::max(1.0, inside)) / kFullContrast);
}

bool NearlySame(const Quadrilateral& a, const Quadrilateral& b) {
  for (size_t i = 0; i < 4; ++i) {
    if ((a[i] - b[i]).lpNorm<Eigen::Infinity>() > 2.5) return false;
  }
  return true;
}

}  // namespace

double DarkInside(const cv::Mat1b& image, const Quadrilateral& corners_px,
                  const DarknessSettings& settings) {
  double sum = 0.0;
  for (size_t i = 0; i < 4; ++i) {
    const Vector2d from = corners_px[i];
    const Vector2d side = corners_px[(i + 1) % 4] - from;
    const Vector2d inwards = Vector2d(-side.y(), side.x()).normalized();
    for (int k = 0; k < kPlaces; ++k) {
      const double share = kEndShare + (1.0 - 2.0 * kEndShare) * (k + 0.5) / kPlaces;
      sum += Contrast(image, from + share * side, inwards, settings);
    }
  }
  return sum / (4 * kPlaces);
}

std::vector<DarkQuadrilateral> FindDarkQuadrilaterals(const cv::Mat1b& image,
                                                      const EdgeSegments& segments,
                                                      const DarknessSettings& settings,
                                                      size_t most) {
  const auto& [tops, rights, bottoms, lefts] = segments;
  const auto tops_of_lefts = Corners(lefts, tops, true);
  const auto bottoms_of_lefts = Corners(lefts, bottoms, false);
  const auto tops_of_rights = Corners(rights, tops, false);
  const auto bottoms_of_rights = Corners(rights, bottoms, true);
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
          if (IsConvex(q)) found.push_back({q, DarkInside(image, q, settings)});
        }
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.clarity > b.clarity; });
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
