#include "vision/stereo/paper/block_matching.h"

#include <cmath>
#include <opencv2/calib3d.hpp>

#include "core/system/check.h"

namespace fenestra {
namespace {

constexpr int kSubpixels = cv::StereoMatcher::DISP_SCALE;
// The default of cv::StereoBM. With a larger cap, sums would not fit the 16 bits of its fast path.
constexpr int kPreFilterCap = 31;

// cv::StereoBM searches a multiple of 16 disparities.
int SearchedDisparities(const BlockMatchingSettings& settings) {
  const int wanted = settings.nearest_disparity_px - settings.farthest_disparity_px + 1;
  return (wanted + 15) / 16 * 16;
}

cv::Ptr<cv::StereoBM> MakeMatcher(const BlockMatchingSettings& settings) {
  // Makes a new matcher each time, since it owns buffers and detectors are used by many threads.
  auto matcher = cv::StereoBM::create(SearchedDisparities(settings), settings.window_px);
  matcher->setMinDisparity(settings.farthest_disparity_px);
  matcher->setPreFilterType(cv::StereoBM::PREFILTER_XSOBEL);
  matcher->setPreFilterCap(kPreFilterCap);
  matcher->setUniquenessRatio(settings.uniqueness_percent);
  matcher->setTextureThreshold(settings.texture_threshold);
  matcher->setDisp12MaxDiff(settings.left_right_check ? 1 : -1);
  return matcher;
}

}  // namespace

cv::Mat1s MatchPadded(const RectifiedPair& pair, const BlockMatchingSettings& settings) {
  const int rim = settings.window_px / 2;
  const int left_pad = settings.farthest_disparity_px + SearchedDisparities(settings) - 1 + rim;
  RectifiedPair padded;
  cv::copyMakeBorder(pair.left, padded.left, rim, rim, left_pad, rim, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(pair.right, padded.right, rim, rim, left_pad, rim, cv::BORDER_REPLICATE);
  cv::Mat1s raw;
  MakeMatcher(settings)->compute(padded.left, padded.right, raw);
  return raw(cv::Rect({left_pad, rim}, pair.left.size())).clone();
}

cv::Mat1f MatchBlocks(const RectifiedPair& pair, const cv::Mat1b& left_seen,
                      const cv::Mat1b& right_seen, const BlockMatchingSettings& settings) {
  FENESTRA_CHECK(pair.left.size() == pair.right.size() && pair.left.size() == left_seen.size() &&
                     pair.left.size() == right_seen.size(),
                 "one size for all images");
  FENESTRA_CHECK(settings.farthest_disparity_px >= 0 &&
                     settings.farthest_disparity_px <= settings.nearest_disparity_px,
                 "disparities in order");
  cv::Mat1s raw = MatchPadded(pair, settings);
  const int none = (settings.farthest_disparity_px - 1) * kSubpixels;
  for (int v = 0; v < raw.rows; ++v) {
    short* row = raw[v];
    const uchar* left_row = left_seen[v];
    const uchar* right_row = right_seen[v];
    for (int u = 0; u < raw.cols; ++u) {
      const int d = row[u];
      if (d <= 0 || d <= none) {
        row[u] = 0;
        continue;
      }
      const int u_right = u - (d + kSubpixels / 2) / kSubpixels;
      if (left_row[u] == 0 || u_right < 0 || right_row[u_right] == 0) row[u] = 0;
    }
  }
  if (settings.speckle_area_px > 0) {
    cv::filterSpeckles(raw, 0, settings.speckle_area_px,
                       static_cast<int>(std::lround(settings.speckle_step_px * kSubpixels)));
  }
  cv::Mat1f disparity;
  raw.convertTo(disparity, CV_32F, 1.0 / kSubpixels);
  return disparity;
}

}  // namespace fenestra
