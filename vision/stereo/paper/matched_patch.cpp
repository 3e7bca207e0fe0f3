#include "vision/stereo/paper/matched_patch.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

// More patches than this are texture rather than a frame on a wall. The limit bounds the number of
// pairs that are tried.
constexpr size_t kMostPatches = 16;
// Only matches a block apart are nearly uncorrelated, so more samples would not improve the planes.
constexpr int kSamplesPerPatch = 200;

cv::Mat Block(int width, int height) {
  return cv::getStructuringElement(cv::MORPH_RECT, {width, height});
}

// Splits disparities where they leave a gap of more than `step_px`. Returns the upper ends of all
// clusters but the last, in ascending order.
std::vector<float> ClusterEnds(std::vector<float> disparities, double step_px) {
  std::sort(disparities.begin(), disparities.end());
  std::vector<float> ends;
  for (size_t i = 1; i < disparities.size(); ++i) {
    if (disparities[i] - disparities[i - 1] > step_px) ends.push_back(disparities[i - 1]);
  }
  return ends;
}

std::vector<float> ValuesOf(const cv::Mat1f& disparity, const cv::Mat1b& mask) {
  std::vector<float> values;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (mask(v, u) != 0) values.push_back(disparity(v, u));
    }
  }
  return values;
}

// `usable` marks the patch's pixels within `box`, at least one.
MatchedPatch DescribePatch(const cv::Mat1b& usable, const cv::Rect& box,
                           const cv::Mat1f& disparity) {
  std::vector<cv::Point> pixels;
  cv::findNonZero(usable, pixels);
  for (cv::Point& pixel : pixels) pixel += box.tl();
  MatchedPatch patch{.box = cv::boundingRect(pixels),
                     .area_px = static_cast<int>(pixels.size()),
                     .hull = {},
                     .samples = {}};
  cv::convexHull(pixels, patch.hull);
  // Samples lie on a grid, since every n-th pixel of a region n - 1 or n + 1 pixels wide would be a
  // slanted line.
  const int step = std::max(
      1, static_cast<int>(std::sqrt(patch.area_px / static_cast<double>(kSamplesPerPatch))));
  for (const cv::Point& pixel : pixels) {
    if ((pixel.x - patch.box.x) % step != 0 || (pixel.y - patch.box.y) % step != 0) continue;
    patch.samples.push_back(
        {static_cast<float>(pixel.x), static_cast<float>(pixel.y), disparity(pixel)});
  }
  return patch;
}

// A connected region may hold several surfaces, or a surface and false matches beside it.
std::vector<MatchedPatch> SplitByDisparity(const cv::Mat1b& usable, const cv::Rect& box,
                                           const cv::Mat1f& disparity,
                                           const PatchSettings& settings) {
  std::vector<float> ends =
      ClusterEnds(ValuesOf(disparity(box), usable), settings.disparity_step_px);
  ends.push_back(std::numeric_limits<float>::max());
  std::vector<MatchedPatch> patches;
  float from = 0.0f;
  for (const float to : ends) {
    const cv::Mat1b cluster = usable & (disparity(box) > from) & (disparity(box) <= to);
    from = to;
    if (cv::countNonZero(cluster) == 0) continue;
    MatchedPatch patch = DescribePatch(cluster, box, disparity);
    if (patch.box.height >= settings.min_height_px) patches.push_back(std::move(patch));
  }
  return patches;
}

// The box of all matched pixels with an empty rim that is wide enough for the morphology to give
// the same result as in the whole image.
cv::Rect MatchedRegion(const cv::Mat1f& disparity, const PatchSettings& settings) {
  const cv::Rect box = cv::boundingRect(cv::Mat1b(disparity > 0.0f));
  if (box.empty()) return {};
  const int rim = settings.opening_px + settings.gap_height_px + settings.gap_width_px;
  const cv::Rect wider(box.x - rim, box.y - rim, box.width + 2 * rim, box.height + 2 * rim);
  return wider & cv::Rect({0, 0}, disparity.size());
}

void Move(const cv::Point& by, MatchedPatch& patch) {
  patch.box += by;
  for (cv::Point& p : patch.hull) p += by;
  for (DisparitySample& s : patch.samples) {
    s.u_px += static_cast<float>(by.x);
    s.v_px += static_cast<float>(by.y);
  }
}

}  // namespace

std::vector<MatchedPatch> FindPatches(const cv::Mat1f& whole, const PatchSettings& settings) {
  // Most of a wall has no matches, and empty areas need no morphology.
  const cv::Rect region = MatchedRegion(whole, settings);
  if (region.empty()) return {};
  const cv::Mat1f disparity = whole(region);
  const cv::Mat1b matched = disparity > 0.0f;
  cv::Mat1b opened;
  cv::morphologyEx(matched, opened, cv::MORPH_OPEN,
                   Block(settings.opening_px, settings.opening_px));
  cv::Mat1b closed;
  cv::morphologyEx(opened, closed, cv::MORPH_CLOSE,
                   Block(settings.gap_width_px | 1, settings.gap_height_px | 1));
  cv::Mat1i labels;
  cv::Mat1i stats;
  cv::Mat1d centroids;
  const int count = cv::connectedComponentsWithStats(closed, labels, stats, centroids, 8, CV_32S);
  std::vector<MatchedPatch> patches;
  for (int i = 1; i < count; ++i) {
    const cv::Rect box(stats(i, cv::CC_STAT_LEFT), stats(i, cv::CC_STAT_TOP),
                       stats(i, cv::CC_STAT_WIDTH), stats(i, cv::CC_STAT_HEIGHT));
    if (box.height < settings.min_height_px) continue;
    const cv::Mat1b usable = (labels(box) == i) & opened(box);
    std::vector<MatchedPatch> split = SplitByDisparity(usable, box, disparity, settings);
    std::move(split.begin(), split.end(), std::back_inserter(patches));
  }
  for (MatchedPatch& patch : patches) Move(region.tl(), patch);
  std::stable_sort(patches.begin(), patches.end(),
                   [](const auto& p, const auto& q) { return p.area_px > q.area_px; });
  if (patches.size() > kMostPatches) patches.resize(kMostPatches);
  return patches;
}

}  // namespace fenestra
