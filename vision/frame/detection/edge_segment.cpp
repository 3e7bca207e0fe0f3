#include "vision/frame/detection/edge_segment.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/frame/detection/quadrilateral.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr double kSobelOfStep = 3.0;  // Response to a step of 1 DN blurred by a good lens.
// An edge of darkness 1 (4 : 1) rises by 1.2 times the grey value in its middle, weaker ones
// roughly in proportion. Half of that is required, since blur reduces it.
constexpr double kLeastContrast = 0.6;
constexpr double kBend_px = 0.8;
constexpr double kFollow_px = 1.6;  // Largest step between rows; more than that of an edge at 45°.
constexpr int kMissingRows = 2;
constexpr double kObliqueness =
    0.7;  // tan 35°: the directions of neighbouring sides overlap by 20°.

struct ChainPoint {
  double u;
  int v;
};
using Chain = std::vector<ChainPoint>;

// Follows vertical edges down the rows.
class ChainTracker {
 public:
  ChainTracker(int width, const EdgeSegmentSettings& settings)
      : threshold_(kSobelOfStep * settings.darkness.min_contrast_dn),
        relative_threshold_(kSobelOfStep * kLeastContrast * settings.min_darkness),
        black_dn_(settings.darkness.black_dn),
        chain_at_{std::vector<int>(width, -1), std::vector<int>(width, -1)} {}

  void AddRow(int v, const uchar* grey, const short* across, const short* along, int width) {
    // This loop sees every pixel, so it uses integers and begins with the test that most pixels
    // fail.
    const int threshold = static_cast<int>(std::ceil(threshold_));
    for (int u = 1; u + 1 < width; ++u) {
      const int strength = std::abs(across[u]);
      if (strength < threshold) continue;
      const int before = std::abs(across[u - 1]);
      const int after = std::abs(across[u + 1]);
      if (strength < before || strength <= after) continue;
      if (strength < kObliqueness * std::abs(along[u])) continue;
      if (strength < relative_threshold_ * (grey[u] - black_dn_)) continue;
      const double bend = before - 2.0 * strength + after;
      const double offset = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
      Append(across[u] < 0, {u + offset, v});
    }
  }

  // Index 0 is for edges that are dark on their right, 1 for those that are dark on their left.
  const std::vector<Chain>& chains(bool dark_right) const { return chains_[dark_right ? 0 : 1]; }

 private:
  void Append(bool dark_right, const ChainPoint& point) {
    std::vector<Chain>& chains = chains_[dark_right ? 0 : 1];
    std::vector<int>& at = chain_at_[dark_right ? 0 : 1];
    const int u = static_cast<int>(std::lround(point.u));
    int nearest = -1;
    double smallest = kFollow_px;
    for (int i = std::max(0, u - 2); i <= std::min(static_cast<int>(at.size()) - 1, u + 2); ++i) {
      if (at[i] < 0) continue;
      const ChainPoint& last = chains[at[i]].back();
      const int rows = point.v - last.v;
      const double distance = std::abs(last.u - point.u);
      if (rows < 1 || rows > 1 + kMissingRows || distance > smallest) continue;
      smallest = distance;
      nearest = at[i];
    }
    if (nearest < 0) {
      nearest = static_cast<int>(chains.size());
      chains.emplace_back();
    }
    chains[nearest].push_back(point);
    at[u] = nearest;
  }

  double threshold_;
  double relative_threshold_;
  double black_dn_;
  std::array<std::vector<int>, 2> chain_at_;
  std::array<std::vector<Chain>, 2> chains_;
};

// Fits the line u = a + b v to the points [first, last] and returns its part from the first row to
// the last.
EdgeSegment FitLine(const Chain& chain, size_t first, size_t last) {
  double n = 0.0, sum_v = 0.0, sum_u = 0.0;
  for (size_t i = first; i <= last; ++i) {
    n += 1.0;
    sum_v += chain[i].v;
    sum_u += chain[i].u;
  }
  const double mean_v = sum_v / n;
  const double mean_u = sum_u / n;
  double vv = 0.0, uv = 0.0;
  for (size_t i = first; i <= last; ++i) {
    vv += (chain[i].v - mean_v) * (chain[i].v - mean_v);
    uv += (chain[i].v - mean_v) * (chain[i].u - mean_u);
  }
  const double slope = vv > 0.0 ? uv / vv : 0.0;
  const auto at = [&](int v) { return Vector2d(mean_u + slope * (v - mean_v), v); };
  return {at(chain[first].v), at(chain[last].v), 0.0};
}

// Noise at the ends of a chord can feign a bend that the line through all points does not have.
bool IsStraight(const Chain& chain, size_t first, size_t last, const EdgeSegment& line) {
  const Vector2d side = line.to - line.from;
  const double largest = kBend_px * side.norm();
  for (size_t i = first; i <= last; ++i) {
    const Vector2d point(chain[i].u, chain[i].v);
    if (std::abs(Cross(side, point - line.from)) > largest) return false;
  }
  return true;
}

void Split(const Chain& chain, size_t first, size_t last, double min_length_px,
           std::vector<EdgeSegment>& out) {
  const Vector2d p(chain[first].u, chain[first].v);
  const Vector2d q(chain[last].u, chain[last].v);
  const double length = (q - p).norm();
  if (length < min_length_px) return;
  size_t worst = first;
  double largest = kBend_px * length;
  for (size_t i = first + 1; i < last; ++i) {
    const double distance = std::abs(Cross(q - p, Vector2d(chain[i].u, chain[i].v) - p));
    if (distance <= largest) continue;
    largest = distance;
    worst = i;
  }
  const EdgeSegment line = FitLine(chain, first, last);
  if (worst == first || IsStraight(chain, first, last, line)) {
    out.push_back(line);
    return;
  }
  Split(chain, first, worst, min_length_px, out);
  Split(chain, worst, last, min_length_px, out);
}

// Returns the vertical edges of an image with these derivatives, directed downwards: first those
// that are dark on the right, then those that are dark on the left.
std::array<std::vector<EdgeSegment>, 2> UprightSegments(const cv::Mat1b& image,
                                                        const cv::Mat1s& across,
                                                        const cv::Mat1s& along,
                                                        const EdgeSegmentSettings& settings) {
  ChainTracker tracker(across.cols, settings);
  for (int v = 1; v + 1 < across.rows; ++v) {
    tracker.AddRow(v, image.ptr(v), across.ptr<short>(v), along.ptr<short>(v), across.cols);
  }
  std::array<std::vector<EdgeSegment>, 2> segments;
  for (size_t i = 0; i < 2; ++i) {
    for (const Chain& chain : tracker.chains(i == 0)) {
      if (static_cast<double>(chain.size()) < 0.7 * settings.min_length_px) continue;
      Split(chain, 0, chain.size() - 1, settings.min_length_px, segments[i]);
    }
  }
  return segments;
}

EdgeSegment Reversed(const EdgeSegment& s) {
  return {s.to, s.from, s.darkness};
}

EdgeSegment Transposed(const EdgeSegment& s) {
  return {{s.from.y(), s.from.x()}, {s.to.y(), s.to.x()}, s.darkness};
}

}  // namespace

EdgeSegments FollowEdges(const cv::Mat1b& image, const EdgeSegmentSettings& settings) {
  cv::Mat1s du;
  cv::Mat1s dv;
  cv::spatialGradient(image, du, dv, 3, cv::BORDER_REPLICATE);
  const auto upright = UprightSegments(image, du, dv, settings);
  const cv::Mat1s du_transposed = du.t();
  const cv::Mat1s dv_transposed = dv.t();
  const auto level = UprightSegments(image.t(), dv_transposed, du_transposed, settings);
  EdgeSegments all;
  for (const EdgeSegment& s : level[0]) all[0].push_back(Transposed(s));
  for (const EdgeSegment& s : upright[1]) all[1].push_back(s);
  for (const EdgeSegment& s : level[1]) all[2].push_back(Reversed(Transposed(s)));
  for (const EdgeSegment& s : upright[0]) all[3].push_back(Reversed(s));
  return all;
}

}  // namespace fenestra
