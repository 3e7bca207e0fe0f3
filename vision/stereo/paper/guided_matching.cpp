#include "vision/stereo/paper/guided_matching.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

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
