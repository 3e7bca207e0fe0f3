#include "vision/stereo/paper/block_matching.h"

#include <algorithm>
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

// A frame's far side must be within reach of its near side. The depth of a frame of width s that is
// turned by 25° differs by s sin 25° between its sides: 21 % of the distance z for z = 2 s, and
// less farther away.
constexpr double kReach = 0.25;
// One search is for the frame, the second for scenes with a taller object elsewhere.
constexpr int kMostSearches = 2;

float MedianDisparity(const MatchedPatch& patch) {
  std::vector<float> values;
  for (const DisparitySample& s : patch.samples) values.push_back(s.disparity_px);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Tells whether most of a patch was found again at another disparity, i.e. was a double.
bool IsExplained(const MatchedPatch& patch, const cv::Mat1b& open) {
  const auto closed =
      std::count_if(patch.samples.begin(), patch.samples.end(), [&open](const DisparitySample& s) {
        return open(static_cast<int>(s.v_px), static_cast<int>(s.u_px)) == 0;
      });
  return 2 * static_cast<size_t>(closed) > patch.samples.size();
}

struct Band {
  cv::Range rows;
  BlockMatchingSettings settings;
};

Band AroundPatch(const MatchedPatch& patch, float d, int height,
                 const BlockMatchingSettings& settings) {
  Band band{.rows = {std::max(0, patch.box.y - settings.window_px),
                     std::min(height, patch.box.br().y + settings.window_px)},
            .settings = settings};
  band.settings.farthest_disparity_px =
      std::max(settings.farthest_disparity_px, static_cast<int>(std::floor(d * (1.0 - kReach))));
  band.settings.nearest_disparity_px =
      std::min(settings.nearest_disparity_px, static_cast<int>(std::ceil(d * (1.0 + kReach))));
  return band;
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

std::optional<cv::Mat1f> MatchAgainNearPatches(
    const RectifiedPair& pair, const cv::Mat1b& left_seen, const cv::Mat1b& right_seen,
    const BlockMatchingSettings& settings, const cv::Mat1f& disparity,
    const std::vector<MatchedPatch>& patches, double narrowest_in_baselines) {
  std::vector<const MatchedPatch*> tallest;
  for (const MatchedPatch& patch : patches) tallest.push_back(&patch);
  std::stable_sort(tallest.begin(), tallest.end(),
                   [](const auto* p, const auto* q) { return p->box.height > q->box.height; });
  cv::Mat1f result;
  // A double may be tall enough to be searched for as well, so pixels that a taller patch explained
  // are kept.
  cv::Mat1b open(disparity.size(), 255);
  std::vector<float> searched;
  for (const MatchedPatch* patch : tallest) {
    if (searched.size() == kMostSearches) break;
    const float d = MedianDisparity(*patch);
    const bool unique = d * (1.0 + narrowest_in_baselines) > settings.nearest_disparity_px;
    const bool done = std::any_of(searched.begin(), searched.end(), [d](float before) {
      return std::abs(d - before) < kReach * before;
    });
    if (unique || done || IsExplained(*patch, open)) continue;
    searched.push_back(d);
    if (result.empty()) result = disparity.clone();
    const Band band = AroundPatch(*patch, d, disparity.rows, settings);
    const cv::Mat1f again =
        MatchBlocks({pair.left.rowRange(band.rows), pair.right.rowRange(band.rows)},
                    left_seen.rowRange(band.rows), right_seen.rowRange(band.rows), band.settings);
    const cv::Mat1b found = (again > 0.0f) & open.rowRange(band.rows);
    again.copyTo(result.rowRange(band.rows), found);
    open.rowRange(band.rows).setTo(0, found);
  }
  if (result.empty()) return std::nullopt;
  return result;
}

}  // namespace fenestra
