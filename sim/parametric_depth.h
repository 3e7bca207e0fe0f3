#pragma once

#include "core/camera_model.h"
#include "core/random_stream.h"
#include "renderers/ray_caster.h"
#include "sim/depth_frame.h"
#include "sim/disparity_range.h"
#include "sim/infrared_image.h"
#include "sim/speckle_matching.h"

namespace fenestra {

/// Noise of the parametric model, in pixels of a 640-wide image.
struct ParametricDepthOptions {
  /// Standard deviations of the disparity before quantisation: what the laser's speckle and the
  /// place within a pixel make, the same in every frame of a view; and what noise makes of windows
  /// whose dots stand out of it by its own standard deviation. Both fitted to SpeckleDepth before
  /// white walls at 0.8 to 4 m.
  double fixed_disparity_noise_px = 0.045;
  double temporal_disparity_noise_px = 0.28;
  /// Of where a window's evidence is centred: outlines lie that far from where they are seen
  /// (Barron & Handa, simkinect: 0.5).
  double lateral_noise_px = 0.5;
};

/// Throws InputError with all faults.
void Validate(const ParametricDepthOptions& options);

/// Depth from what windows of the infra-red image would hold, without making the image.
///
/// Pixel i of the window around a depth pixel receives dots of strength s_i at disparity d_i and
/// ambient light a_i. With a pattern of mean m and variance v (GatheredPattern), speckle contrast c
/// and noise σ², the image's correlation with the pattern at disparity d is expected to be
///
///     ρ = √v S / √(v ⟨s²⟩ + c² (v + m²) ⟨s²⟩ + var(m s + a) + σ²),
///     S = ⟨s_i exp(-(d_i - d)² / 4 σ_p²)⟩,
///
/// where σ_p² = σ_dot² + 1/12 is the spread of a dot with that of a pixel. d is the disparity of
/// the window's centre or that of its strongest pixel, whichever fits better. Noise of the standard
/// deviation (1 - ρ²)/√n is added to ρ, and SpeckleMatchingOptions decide, as in SpeckleMatcher.
/// The window's disparity is the mean of d_i over its evidence, and noise.
class ParametricDepth {
 public:
  ParametricDepth(const InfraredOptions& infrared, const ParametricDepthOptions& noise,
                  const SpeckleMatchingOptions& matching, const CameraModel& depth,
                  double baseline_m, const DisparityRange& range);

  /// `unit_m`: of the depth image. `shot`: tells this view's fixed noise from others', `frame` this
  /// frame's.
  DepthFrame Observe(const RayCaster& caster, const Lighting& lighting, const Pose& X_WB,
                     double unit_m, const RandomStream& shot, const RandomStream& frame) const;

 private:
  struct Windows;
  struct Match;
  /// Standard normal variates of one window.
  struct Noise {
    float evidence;
    float lateral;
    float fixed;
    float temporal;
  };

  Windows Gather(const AovImages& aovs) const;
  /// Of the window with the pattern at this disparity [px at 640].
  Match MatchAt(const Windows& windows, cv::Point pixel, float disparity_px) const;
  /// Whether the match is accepted, given the best one at another disparity.
  bool IsAccepted(const Match& match, float rival, const Noise& noise) const;
  /// Disparity after noise [px at 640], or NaN.
  float Read(const Windows& windows, cv::Point pixel, const Noise& noise) const;

  InfraredOptions infrared_;
  ParametricDepthOptions noise_;
  SpeckleMatchingOptions matching_;
  DisparityRange range_;
  Eigen::Vector3d p_CP_;
  RayGrid rays_;
  PatternStatistics pattern_;
  double scale_;                  ///< Pixels of a 640-wide image per depth pixel.
  std::vector<float> weights_u_;  ///< Of the window's depth pixels, by how much of them it covers.
  std::vector<float> weights_v_;
};

}  // namespace fenestra
