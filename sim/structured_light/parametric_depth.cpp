#include "sim/structured_light/parametric_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/io/input_error.h"
#include "sim/structured_light/block_evidence.h"
#include "sim/structured_light/explained_depth.h"

namespace fenestra {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// Standard normal at every pixel, but equal to white noise averaged over the block that
// neighbouring pixels share.
cv::Mat1f BlockNoise(const RandomStream& stream, cv::Size size, cv::Size block) {
  const cv::Size reach(block.width / 2, block.height / 2);
  cv::Mat1f white(size.height + 2 * reach.height, size.width + 2 * reach.width);
  stream.FillNormals({white.ptr<float>(), white.total()});
  cv::Mat1f sums;
  cv::boxFilter(white, sums, CV_32F, block, {-1, -1}, false);
  return sums(cv::Rect({reach.width, reach.height}, size)) /
         std::sqrt(static_cast<float>(block.area()));
}

// Width of one of the independent places of the search. A process of autocorrelation exp(-k²/4σ_p²)
// exceeds a high level u at u/(2 √π σ_p) independent places a pixel (Rice): about two, for u = 4.
constexpr double kPlaceWidth_px = 0.5;

// The spread of a dot with that of a pixel.
double SpreadOf(const InfraredOptions& infrared) {
  return std::sqrt(infrared.dot_sigma_px * infrared.dot_sigma_px + 1.0 / 12.0);
}

}  // namespace

void Validate(const ParametricDepthOptions& o) {
  if (o.fixed_disparity_noise_px < 0.0 || o.temporal_disparity_noise_px < 0.0) {
    throw InputError({{"structured-light sensor", 0, 0, "disparity noise must not be negative"}});
  }
}

/// A block with the pattern at one disparity.
struct ParametricDepth::Match {
  float correlation = 0.0f;   ///< ρ
  float variance = 0.0f;      ///< V [DN²]
  float step = 0.0f;          ///< var(m s + a)
  float explained = 0.0f;     ///< ρ² V
  float noise = 0.0f;         ///< σ²
  float strength = 0.0f;      ///< √⟨s²⟩ [DN]
  float disparity_px = 0.0f;  ///< Mean over the evidence.
};

ParametricDepth::ParametricDepth(const InfraredOptions& infrared,
                                 const ParametricDepthOptions& noise,
                                 const PatternMatchingOptions& matching, const CameraModel& depth,
                                 double baseline_m, const DisparityRange& range,
                                 const RollingShutter& shutter)
    : noise_(Validated(noise)),
      matching_(Validated(matching)),
      range_(range),
      shutter_(shutter),
      layout_{.scale = 1,
              .reach = {BlockReach(matching.block_width_px * depth.width_px() /
                                   DisparityRange::kImageWidth),
                        BlockReach(matching.block_height_px * depth.width_px() /
                                   DisparityRange::kImageWidth)}},
      rays_(layout_.CameraOf(depth), layout_.ShutterOf(depth, shutter)),
      response_(infrared, rays_.camera(), {baseline_m, 0.0, 0.0}),
      pattern_mean_(static_cast<float>(response_.pattern_mean())),
      speckle_variance_(static_cast<float>(response_.SpeckleVariance())),
      flicker_over_fixed_(static_cast<float>(response_.FlickerOverFixed())),
      search_px_(matching.SearchEnd(range)),
      scale_(DisparityRange::kImageWidth / depth.width_px()),
      blocks_(matching.block_width_px / scale_, matching.block_height_px / scale_,
              static_cast<double>(pattern_mean_), SpreadOf(infrared)),
      depth_camera_(depth) {
  dots_chance_ = static_cast<float>(SumOfGaussian(2.0 * std::pow(SpreadOf(infrared), 2)));
  const SampledPattern pattern(infrared.dot_sigma_px);
  for (int i = 0; i < kPhases; ++i) {
    const double offset = (i + 0.5) / kPhases;
    // The search goes by half pixels.
    const double step = std::round(2.0 * offset) / 2.0;
    phases_[static_cast<size_t>(i)] = {
        .variance = static_cast<float>(pattern.MomentsAt(offset).variance),
        .match = static_cast<float>(pattern.Correlation(offset, step))};
    whole_besides_ += BesidesIn(phases_[static_cast<size_t>(i)]) / kPhases;
  }
}

ParametricDepth ParametricDepth::WithUnit(const CameraModel& depth,
                                          const DisparityError& error) const {
  ParametricDepth unit = *this;
  unit.depth_camera_ = depth;
  unit.error_ = error;
  unit.rays_ = MovingRays(layout_.CameraOf(depth), layout_.ShutterOf(depth, shutter_));
  unit.response_ = response_.WithCamera(unit.rays_.camera());
  return unit;
}

BlockLight ParametricDepth::LightOf(const AovImages& aovs, double exposure) const {
  const cv::Size size = aovs.depth_m.size();
  BlockLight blocks{cv::Mat1f(size), cv::Mat1f(size), cv::Mat1f(size)};
  const auto fb = static_cast<float>(range_.focal_times_baseline);
  const double saturation_dn = response_.options().saturation_dn;
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const InfraredLight light = response_.LightAt(aovs, {u, v}).At(exposure);
      // A dot may saturate; what counts is how far it stands out of its surroundings.
      const double ambient_dn = std::min(light.ambient_dn, saturation_dn);
      blocks.ambient_dn(v, u) = static_cast<float>(ambient_dn);
      blocks.dots_dn(v, u) = static_cast<float>(std::min(light.dot_dn, saturation_dn - ambient_dn));
      blocks.disparity_px(v, u) =
          std::isfinite(aovs.depth_m(v, u)) ? fb / aovs.depth_m(v, u) : BlockLight::kNoDisparity;
    }
  }
  return blocks;
}

float ParametricDepth::BesidesIn(const Phase& phase) const {
  const float whole = speckle_variance_ * (phase.variance + pattern_mean_ * pattern_mean_);
  const float matched = phase.match * phase.match;
  return (whole + (1.0f - matched) * phase.variance) / (matched * phase.variance);
}

ParametricDepth::Match ParametricDepth::MatchAt(const BlockEvidence& block,
                                                float disparity_px) const {
  Match match;
  if (block.evidence <= 0.0f) return match;
  const float fraction = disparity_px - std::floor(disparity_px);
  const Phase& phase =
      phases_[std::min(static_cast<size_t>(fraction * kPhases), phases_.size() - 1)];
  const float smooth = pattern_mean_ * block.dots + block.ambient;
  match.noise = static_cast<float>(response_.NoiseVariance(static_cast<double>(smooth)));
  match.step = std::max(0.0f, block.smooth2 - smooth * smooth);
  match.variance =
      (phase.variance + speckle_variance_ * (phase.variance + pattern_mean_ * pattern_mean_)) *
          block.dots2 +
      match.step + match.noise;
  const float signal = phase.match * block.evidence;
  match.explained = phase.variance * signal * signal;
  match.correlation = std::sqrt(match.explained / match.variance);
  match.strength = std::sqrt(block.dots2);
  match.disparity_px = block.disparity / block.evidence;
  return match;
}

float ParametricDepth::Measured(const Match& match, float noise) const {
  // Fitted to PatternMatcher on walls: the search takes the best of several places around the right
  // one, and blocks hold more or fewer dots.
  constexpr float kBestOfSeveral = 0.5f;
  constexpr float kSpread = 0.95f;
  const float rho = match.correlation;
  const float deviation = (1.0f - rho * rho) / std::sqrt(Pixels());
  return std::min(1.0f, rho + deviation * (kBestOfSeveral + kSpread * noise));
}

float ParametricDepth::BestByChance(const Match& match, float enough, const Noise& noise) const {
  // Two processes of autocorrelations r and r' correlate by chance with the variance Σ r r'/n:
  // 1/n if one of them is white. Steps count as white, since dots are spread evenly.
  const float excess =
      match.variance > 0.0f ? (dots_chance_ - 1.0f) * match.explained / match.variance : 0.0f;
  const double deviation = std::sqrt(static_cast<double>((1.0f + excess) / Pixels()));
  return ChanceMatch{.deviation = deviation, .places = search_px_ / kPlaceWidth_px}.Best(
      enough, noise.chance);
}

float ParametricDepth::Read(const BlockLight& light, const BlockEvidence& block, cv::Point centre,
                            const Noise& noise) const {
  // A saturated block does not even have noise that could match.
  if (block.ambient >= static_cast<float>(response_.options().saturation_dn - 0.5)) return kNaN;
  const float own_px = light.disparity_px(centre);
  const float strongest_px = block.strongest_disparity;
  Match match = MatchAt(block, own_px);
  float measured = Measured(match, noise.evidence);
  if (std::abs(strongest_px - own_px) > 1.0f) {
    const Match rival = MatchAt(blocks_.At(light, centre, strongest_px), strongest_px);
    const float measured_rival = Measured(rival, noise.rival);
    if (measured_rival > measured) {
      match = rival;
      measured = measured_rival;
    }
  }
  const auto least = static_cast<float>(matching_.least_correlation);
  if (BestByChance(match, std::max(least, measured), noise) > 0.0f) {
    return static_cast<float>(search_px_ * NormalShare(static_cast<double>(noise.temporal)));
  }
  if (measured < least || match.explained <= 0.0f) return kNaN;
  return match.disparity_px + DisparityNoise(match, measured, noise);
}

float ParametricDepth::DisparityNoise(const Match& match, float measured,
                                      const Noise& noise) const {
  // Variance besides pattern and noise disturbs a block as the laser's speckle disturbs a whole
  // one. A quarter of the variance of a step in brightness, where an outline crosses, counts. That
  // is fitted, as is the root by which blocks with a better correlation than expected have less
  // noise.
  constexpr float kOfStep = 0.25f;
  const float besides = std::max(
      0.0f, match.variance - match.explained - match.noise - (1.0f - kOfStep) * match.step);
  const float disturbed = std::sqrt(besides / (match.explained * whole_besides_));
  const float noisy =
      std::sqrt(match.noise * std::min(1.0f, match.correlation / measured)) / match.strength;
  const float flicker = flicker_over_fixed_ * noise.flicker;
  return static_cast<float>(noise_.fixed_disparity_noise_px) * disturbed * (noise.fixed + flicker) +
         static_cast<float>(noise_.temporal_disparity_noise_px) * noisy * noise.temporal;
}

ExplainedDepth ParametricDepth::Observe(const RayCaster& caster, const Lighting& lighting,
                                        const Pose& X_WB, double unit_m, const RandomStream& shot,
                                        const RandomStream& image_noise) const {
  const AovImages aovs = rays_.CastAovs(caster, X_WB, lighting, response_.p_CP());
  const double exposure = response_.Exposure(aovs);
  const BlockLight light = LightOf(aovs, exposure);
  const cv::Size size(depth_camera_.width_px(), depth_camera_.height_px());
  const cv::Size block(2 * blocks_.reach_u() + 1, 2 * blocks_.reach_v() + 1);
  const cv::Mat1f evidence = BlockNoise(image_noise.Child("evidence"), size, block);
  const cv::Mat1f rival = BlockNoise(image_noise.Child("rival"), size, block);
  const cv::Mat1f chance = BlockNoise(image_noise.Child("chance"), size, block);
  const cv::Mat1f fixed = BlockNoise(shot.Child("laser_speckle"), size, block);
  const cv::Mat1f flicker = BlockNoise(image_noise.Child("flicker"), size, block);
  const cv::Mat1f temporal = BlockNoise(image_noise.Child("disparity"), size, block);
  const MissingReturn missing(response_, exposure, matching_, range_);
  ExplainedDepth result{.depth = {.raw = cv::Mat1w::zeros(size), .unit_m = unit_m},
                        .no_return = cv::Mat1b::zeros(size)};
  for (int v = 0; v < size.height; ++v) {
    const std::vector<BlockEvidence> row = blocks_.Row(light, layout_.CentreOf({0, v}).y);
    for (int u = 0; u < size.width; ++u) {
      const cv::Point pixel(u, v);
      const cv::Point centre = layout_.CentreOf(pixel);
      NoReturn reason = NoReturn::kNone;
      double z_m = 0.0;
      if (!layout_.HasBlock(pixel, depth_camera_)) {
        reason = NoReturn::kBorder;
      } else {
        const float disparity_px = Read(light, row[static_cast<size_t>(u)], centre,
                                        {.evidence = evidence(pixel),
                                         .rival = rival(pixel),
                                         .chance = chance(pixel),
                                         .fixed = fixed(pixel),
                                         .flicker = flicker(pixel),
                                         .temporal = temporal(pixel)});
        if (std::isfinite(disparity_px)) {
          z_m = range_.Depth(static_cast<double>(error_.Of(disparity_px, pixel)));
          if (z_m == 0.0) reason = NoReturn::kRange;
        } else {
          reason = missing.Reason(aovs, centre);
        }
      }
      result.depth.raw(pixel) = static_cast<uint16_t>(std::lround(z_m / unit_m));
      result.no_return(pixel) = static_cast<unsigned char>(reason);
    }
  }
  return result;
}

}  // namespace fenestra
