#include "vision/stereo/paper/matched_patch.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fenestra {
namespace {

constexpr PatchSettings kPatchSettings{.opening_px = 5,
                                       .gap_height_px = 21,
                                       .gap_width_px = 5,
                                       .min_height_px = 20,
                                       .disparity_step_px = 2.0};

// An image without matches but for these boxes of one disparity each.
cv::Mat1f Matches(const std::vector<std::pair<cv::Rect, float>>& boxes) {
  cv::Mat1f disparity(240, 320, 0.0f);
  for (const auto& [box, value] : boxes) disparity(box) = value;
  return disparity;
}

std::vector<MatchedPatch> PatchesIn(const std::vector<std::pair<cv::Rect, float>>& boxes) {
  return FindPatches(Matches(boxes), kPatchSettings);
}

TEST(MatchedPatch, IsTheBoxThatWasMatched) {
  const cv::Rect box(50, 60, 40, 80);
  const auto patches = PatchesIn({{box, 30.0f}});
  ASSERT_EQ(patches.size(), 1u);
  const MatchedPatch& patch = patches.front();
  EXPECT_EQ(patch.box, box);
  EXPECT_EQ(patch.area_px, box.area());
  EXPECT_FALSE(patch.samples.empty());
  for (const DisparitySample& sample : patch.samples) {
    EXPECT_EQ(sample.disparity_px, 30.0);
  }
  for (const cv::Point& corner : patch.hull) EXPECT_TRUE(box.contains(corner));
}

TEST(MatchedPatch, TheLargestComesFirst) {
  const auto patches = PatchesIn(
      {{{20, 20, 20, 40}, 30.0f}, {{100, 20, 60, 90}, 30.0f}, {{220, 20, 30, 60}, 30.0f}});
  ASSERT_EQ(patches.size(), 3u);
  EXPECT_TRUE(std::is_sorted(patches.begin(), patches.end(),
                             [](const auto& a, const auto& b) { return a.area_px > b.area_px; }));
}

TEST(MatchedPatch, SpecklesAndShortPiecesAreDropped) {
  EXPECT_TRUE(PatchesIn({{{50, 60, 3, 100}, 30.0f}}).empty()) << "narrower than the opening";
  EXPECT_TRUE(PatchesIn({{{50, 60, 100, 12}, 30.0f}}).empty()) << "shorter than asked for";
}

// Block matching matches upright edges; it is their pieces that have to be joined again.
TEST(MatchedPatch, PiecesOfOneUprightEdgeAreJoined) {
  const auto above_each_other = PatchesIn({{{50, 40, 20, 50}, 30.0f}, {{50, 104, 20, 50}, 30.0f}});
  EXPECT_EQ(above_each_other.size(), 1u);
  const auto beside_each_other = PatchesIn({{{50, 40, 20, 80}, 30.0f}, {{84, 40, 20, 80}, 30.0f}});
  EXPECT_EQ(beside_each_other.size(), 2u);
  const auto far_apart = PatchesIn({{{50, 20, 20, 50}, 30.0f}, {{50, 120, 20, 50}, 30.0f}});
  EXPECT_EQ(far_apart.size(), 2u);
}

TEST(MatchedPatch, AStepOfTheDisparityParts) {
  // Two surfaces side by side, one image region.
  const auto parted = PatchesIn({{{50, 40, 30, 80}, 30.0f}, {{80, 40, 30, 80}, 36.0f}});
  ASSERT_EQ(parted.size(), 2u);
  for (const MatchedPatch& patch : parted) {
    const auto [low, high] = std::minmax_element(
        patch.samples.begin(), patch.samples.end(),
        [](const auto& a, const auto& b) { return a.disparity_px < b.disparity_px; });
    EXPECT_EQ(low->disparity_px, high->disparity_px);
  }
  // A slanted one changes as much, without a gap.
  cv::Mat1f slanted = Matches({});
  for (int u = 50; u < 110; ++u) {
    slanted.col(u).rowRange(40, 120) = 30.0f + 0.1f * static_cast<float>(u - 50);
  }
  EXPECT_EQ(FindPatches(slanted, kPatchSettings).size(), 1u);
}

TEST(MatchedPatch, WithoutMatchesThereIsNone) {
  EXPECT_TRUE(PatchesIn({}).empty());
}

}  // namespace
}  // namespace fenestra
