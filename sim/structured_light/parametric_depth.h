#pragma once

#include <array>

#include "core/geometry/camera_model.h"
#include "core/random/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/motion/rolling_shutter.h"
#include "sim/structured_light/block_evidence.h"
#include "sim/structured_light/disparity.h"
#include "sim/structured_light/explained_depth.h"
#include "sim/structured_light/infrared_response.h"
#include "sim/structured_light/infrared_view.h"
#include "sim/structured_light/pattern_matching.h"
#include "sim/structured_light/sensor_unit.h"

namespace fenestra {

/// Noise of the parametric model, in pixels of a 640-wide image. Both fitted to MatchedDepth before
/// white walls.
struct ParametricDepthOptions {
  /// Standard deviation of the disparity before quantisation by the laser's speckle that stays the
  /// same in every image of a view, in a whole block, at the contrast that is InfraredOptions'
  /// default; it does not follow another contrast. That of the flicker is in proportion.
  double fixed_disparity_noise_px = 0.052;
  /// That by the images' noise, in blocks whose dots exceed it by its own standard deviation.
  double temporal_disparity_noise_px = 0.28;
};

/// Throws InputError with all faults.
void Validate(const ParametricDepthOptions& options);

/// Depth from the expected contents of the infra-red image's blocks, without making the image.
///
/// Pixel i of the block around a depth pixel receives dots of strength s_i at disparity d_i and
/// ambient light a_i. With a pattern of mean m and variance v (SampledPattern, displaced by d),
/// speckle contrast c and noise σ², the image's correlation with the pattern at disparity d is
/// expected to be
///
///     ρ = κ √v S / √V,  V = v ⟨s²⟩ + c² (v + m²) ⟨s²⟩ + var(m s + a) + σ²,
///     S = ⟨s_i exp(-(d_i - d)² / 4 σ_p²)⟩,
///
/// where σ_p² = σ_dot² + 1/12 is the spread of a dot with that of a pixel and κ the correlation of
/// the pattern at d with itself at the nearest step of the search. Noise of the standard deviation
/// (1 - ρ²)/√n is added to ρ. Of three places the one that fits best is the match, and is accepted
/// as in PatternMatcher: the disparity of the block's centre; that of its strongest pixel; and the
/// best of the N other places of the search, which correlate by chance, by the greatest of N normal
/// numbers of deviation 1/√n. The block's disparity is the mean of d_i over its evidence, and
/// noise: the fixed part in proportion to √((V - ρ²V - σ²)/ρ²V), the temporal one to σ/√⟨s²⟩.
class ParametricDepth {
 public:
  ParametricDepth(const InfraredOptions& infrared, const ParametricDepthOptions& noise,
                  const PatternMatchingOptions& matching, const CameraModel& depth,
                  double baseline_m, const DisparityRange& range, const RollingShutter& shutter);

  /// The same with another camera, and with a unit's error of disparities.
  ParametricDepth WithUnit(const CameraModel& depth, const DisparityError& error) const;

  const InfraredResponse& response() const { return response_; }

  /// `unit_m`: the unit of the depth image. `shot`: the stream of this view's fixed noise;
  /// `image_noise`: that of this image's own noise.
  ExplainedDepth Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                         double unit_m, const RandomStream& shot,
                         const RandomStream& image_noise) const;

 private:
  struct Match;
  /// Standard normal variates of one block.
  struct Noise {
    float evidence;
    float rival;
    float chance;
    float fixed;
    float flicker;
    float temporal;
  };
  /// The pattern at a displacement by a fraction of a pixel.
  struct Phase {
    float variance;  ///< v
    float match;     ///< κ
  };
  static constexpr int kPhases = 16;

  float Pixels() const {
    return static_cast<float>(matching_.block_width_px * matching_.block_height_px);
  }
  BlockLight LightOf(const AovImages& aovs, double exposure) const;
  /// Match of the block with the pattern at this disparity [px at 640].
  Match MatchAt(const BlockEvidence& block, float disparity_px) const;
  /// Variance of a whole block besides match and noise, over the variance that the match explains.
  float BesidesIn(const Phase& phase) const;
  /// The correlation as measured, with standard normal noise.
  float Measured(const Match& match, float noise) const;
  /// The best correlation of all wrong places if it is more than `enough`, or else -1.
  float BestByChance(const Match& match, float enough, const Noise& noise) const;
  /// Noise of the disparity [px at 640].
  float DisparityNoise(const Match& match, float measured, const Noise& noise) const;
  /// Disparity after noise [px at 640], or NaN. `centre`: of the block, in `light`.
  float Read(const BlockLight& light, const BlockEvidence& block, cv::Point centre,
             const Noise& noise) const;

  ParametricDepthOptions noise_;
  PatternMatchingOptions matching_;
  DisparityRange range_;
  RollingShutter shutter_;
  InfraredImageLayout layout_;  ///< Of an infra-red image with the depth image's pixels.
  MovingRays rays_;
  InfraredResponse response_;
  float pattern_mean_;
  float speckle_variance_;
  std::array<Phase, kPhases> phases_;
  float whole_besides_ = 0.0f;  ///< BesidesIn, the mean of all phases.
  float dots_chance_ = 1.0f;    ///< Σ r² of the pattern's autocorrelation r = exp(-k²/4σ_p²).
  float flicker_over_fixed_;    ///< Contrast of the flicker over that of the fixed speckle.
  double search_px_;            ///< Disparities are searched up to this [px at 640].
  double scale_;                ///< Pixels of a 640-wide image per depth pixel.
  BlockGatherer blocks_;
  DisparityError error_;
  CameraModel depth_camera_;
};

}  // namespace fenestra
