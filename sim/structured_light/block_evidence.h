#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace fenestra {

/// Light that the pixels of a depth image receive from the projector and from the surroundings.
struct BlockLight {
  cv::Mat1f dots_dn;       ///< s: brightness of a dot.
  cv::Mat1f ambient_dn;    ///< a: ambient light.
  cv::Mat1f disparity_px;  ///< d [px of a 640-wide image]; kNoDisparity where nothing is hit.
  static constexpr float kNoDisparity = 1e6f;
};

/// Weighted means ⟨·⟩ over a block; e = s exp(-(d_i - d)²/4σ²) is a pixel's evidence for the
/// disparity d.
struct BlockEvidence {
  float dots = 0.0f;       ///< ⟨s⟩
  float dots2 = 0.0f;      ///< ⟨s²⟩
  float ambient = 0.0f;    ///< ⟨a⟩
  float smooth2 = 0.0f;    ///< ⟨(m s + a)²⟩, m: mean of the pattern.
  float evidence = 0.0f;   ///< ⟨e⟩
  float disparity = 0.0f;  ///< ⟨e d⟩
  float strongest = 0.0f;  ///< Greatest s.
  float strongest_disparity = 0.0f;
};

/// Number of pixels from the centre of a block to its outermost ones, which may count in part.
int BlockReach(double side_px);

/// Computes the evidence of blocks whose sides need not be whole pixels: the outermost pixels count
/// in part.
class BlockGatherer {
 public:
  /// Sides in pixels of the images; pattern_mean: m; spread_px: σ.
  BlockGatherer(double width_px, double height_px, double pattern_mean, double spread_px);

  /// Number of columns or rows from the centre to the outermost pixels of a block.
  int reach_u() const { return static_cast<int>(weights_u_.size()) / 2; }
  int reach_v() const { return static_cast<int>(weights_v_.size()) / 2; }

  /// Evidence of all blocks around pixels of row v that lie wholly in the image, for the
  /// disparities of their own centres. The first block is that around column reach_u().
  std::vector<BlockEvidence> Row(const BlockLight& light, int v) const;
  /// Evidence of the block around a pixel, for this disparity.
  BlockEvidence At(const BlockLight& light, cv::Point pixel, float disparity_px) const;

 private:
  /// Gathers `count` consecutive blocks starting at `first`, one disparity each.
  std::vector<BlockEvidence> Gather(const BlockLight& light, cv::Point first,
                                    const float* disparity_px, int count) const;

  std::vector<float> weights_u_;  ///< Weights of columns; their sum is 1, as is that of the rows.
  std::vector<float> weights_v_;
  float pattern_mean_;
  float narrowness_;  ///< 1/4σ².
};

/// The greatest of N independent normal numbers of mean 0 and deviation σ: P(best < x) = Φ(x/σ)^N.
struct ChanceMatch {
  double deviation;
  double places;  ///< N ≥ 1.

  /// The greatest number, drawn by the standard normal number ν, if it is more than `enough`; else
  /// -1.
  float Best(float enough, float nu) const;
};

/// Φ, the distribution of a standard normal number.
double NormalShare(double x);

/// Σ exp(-k²/w) over all pixels k of a plane.
double SumOfGaussian(double w);

}  // namespace fenestra
