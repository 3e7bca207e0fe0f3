#include "vision/stereo/matched_patch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

// More patches than this are texture, not a frame on a wall; it bounds the pairs to be tried.
constexpr size_t kMostPatches = 16;
// Matches a window apart are hardly correlated, so more samples would not make planes better.
constexpr int kSamplesPerPatch = 200;

cv::Mat Block(int width, int height) {
  return cv::getStructuringElement(cv::MORPH_RECT, {width, height});
}

MatchedPatch DescribePatch(const cv::Mat1i& labels, int label, const cv::Rect& box,
                           const cv::Mat1b& matched, const cv::Mat1f& disparity) {
  MatchedPatch patch{.box = box, .area_px = 0, .hull = {}, .samples = {}};
  const cv::Mat1b region = labels(box) == label;
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(region, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE, box.tl());
  cv::convexHull(contours.front(), patch.hull);
  const cv::Mat1b usable = region & matched(box);
  patch.area_px = cv::countNonZero(usable);
  // A grid, since every n-th pixel of a region n - 1 or n + 1 pixels wide is a slanted line.
  const int step = std::max(
      1, static_cast<int>(std::sqrt(patch.area_px / static_cast<double>(kSamplesPerPatch))));
  for (int v = 0; v < box.height; v += step) {
    for (int u = 0; u < box.width; u += step) {
      if (usable(v, u) == 0) continue;
      patch.samples.push_back({static_cast<float>(box.x + u), static_cast<float>(box.y + v),
                               disparity(box.y + v, box.x + u)});
    }
  }
  return patch;
}

}  // namespace

std::vector<MatchedPatch> FindPatches(const cv::Mat1f& disparity, const PatchSettings& settings) {
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
  std::vector<int> kept;
  for (int i = 1; i < count; ++i) {
    if (stats(i, cv::CC_STAT_HEIGHT) >= settings.min_height_px) kept.push_back(i);
  }
  std::stable_sort(kept.begin(), kept.end(), [&stats](int i, int j) {
    return stats(i, cv::CC_STAT_AREA) > stats(j, cv::CC_STAT_AREA);
  });
  if (kept.size() > kMostPatches) kept.resize(kMostPatches);
  std::vector<MatchedPatch> patches;
  for (const int i : kept) {
    const cv::Rect box(stats(i, cv::CC_STAT_LEFT), stats(i, cv::CC_STAT_TOP),
                       stats(i, cv::CC_STAT_WIDTH), stats(i, cv::CC_STAT_HEIGHT));
    MatchedPatch patch = DescribePatch(labels, i, box, opened, disparity);
    if (!patch.samples.empty()) patches.push_back(std::move(patch));
  }
  return patches;
}

}  // namespace fenestra
