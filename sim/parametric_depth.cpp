#include "sim/parametric_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/input_error.h"
#include "sim/missing_return.h"

namespace fenestra {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// How much of each pixel a window of this width covers, from the outermost to the outermost.
std::vector<float> Weights(double width_px) {
  const int reach = static_cast<int>(std::ceil(0.5 * width_px - 0.5));
  std::vector<float> weights;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(static_cast<float>(std::clamp(0.5 * width_px - std::abs(i) + 0.5, 0.0, 1.0)));
  }
  return weights;
}

// Standard normal at every pixel, but equal to white noise averaged over the window that
// neighbouring pixels share.
cv::Mat1f WindowNoise(const RandomStream& stream, cv::Size size, cv::Size window) {
  const cv::Size reach(window.width / 2, window.height / 2);
  cv::Mat1f white(size.height + 2 * reach.height, size.width + 2 * reach.width);
  stream.FillNormals({white.ptr<float>(), white.total()});
  cv::Mat1f sums;
  cv::boxFilter(white, sums, CV_32F, window, {-1, -1}, false);
  return sums(cv::Rect({reach.width, reach.height}, size)) /
         std::sqrt(static_cast<float>(window.area()));
}

float Squared(float x) {
  return x * x;
}

}  // namespace

void Validate(const ParametricDepthOptions& o) {
  if (o.fixed_disparity_noise_px < 0.0 || o.temporal_disparity_noise_px < 0.0 ||
      o.lateral_noise_px < 0.0) {
    throw InputError(
        {{"structured-light sensor", 0, 0, "disparity and lateral noise must not be negative"}});
  }
}

/// What depth pixels receive; disparities in pixels of a 640-wide image.
struct ParametricDepth::Windows {
  cv::Mat1f dots_dn;
  cv::Mat1f ambient_dn;
  cv::Mat1f disparity_px;  ///< NaN where nothing is hit.
};

/// Means over a window.
struct ParametricDepth::Match {
  float correlation = 0.0f;
  float evidence = 0.0f;       ///< S, in dots' DN.
  float unexplained = 0.0f;    ///< Variance besides noise and S's.
  float noise_dn = 0.0f;       ///< σ.
  float strength2 = 0.0f;      ///< ⟨s²⟩.
  float off_centre_px = 0.0f;  ///< Of the evidence, along the rows, in a 640-wide image.
  float disparity_px = 0.0f;   ///< Mean over the evidence.
  cv::Point strongest;
};

ParametricDepth::ParametricDepth(const InfraredOptions& infrared,
                                 const ParametricDepthOptions& noise,
                                 const SpeckleMatchingOptions& matching, const CameraModel& depth,
                                 double baseline_m, const DisparityRange& range)
    : infrared_((Validate(infrared), infrared)),
      noise_((Validate(noise), noise)),
      matching_((Validate(matching), matching)),
      range_(range),
      p_CP_(baseline_m, 0.0, 0.0),
      rays_(depth),
      pattern_(GatheredPattern(infrared.dot_sigma_px).Statistics()),
      scale_(DisparityRange::kImageWidth / depth.width_px()),
      weights_u_(Weights(matching.window_width_px / scale_)),
      weights_v_(Weights(matching.window_height_px / scale_)) {}

ParametricDepth::Windows ParametricDepth::Gather(const AovImages& aovs) const {
  const cv::Size size = aovs.depth_m.size();
  Windows windows{cv::Mat1f(size), cv::Mat1f(size), cv::Mat1f(size)};
  const auto fb = static_cast<float>(range_.focal_times_baseline);
  const CameraParameters& k = rays_.camera().parameters();
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const Eigen::Vector3d ray((u - k.cx_px) / k.fx_px, (v - k.cy_px) / k.fy_px, 1.0);
      const InfraredLight light = InfraredLightAt(infrared_, aovs, {u, v}, ray, p_CP_);
      // A dot may saturate; what counts is how far it stands out of its surroundings.
      const double ambient_dn = std::min(light.ambient_dn, infrared_.saturation_dn);
      windows.ambient_dn(v, u) = static_cast<float>(ambient_dn);
      windows.dots_dn(v, u) =
          static_cast<float>(std::min(light.dot_dn, infrared_.saturation_dn - ambient_dn));
      windows.disparity_px(v, u) = fb / aovs.depth_m(v, u);
    }
  }
  return windows;
}

ParametricDepth::Match ParametricDepth::MatchAt(const Windows& windows, cv::Point pixel,
                                                float disparity_px) const {
  const int reach_u = static_cast<int>(weights_u_.size()) / 2;
  const int reach_v = static_cast<int>(weights_v_.size()) / 2;
  const auto mean = static_cast<float>(pattern_.mean);
  const auto variance = static_cast<float>(pattern_.variance);
  const auto spread2 =
      static_cast<float>(infrared_.dot_sigma_px * infrared_.dot_sigma_px + 1.0 / 12.0);
  float weight_sum = 0.0f;
  float strengths = 0.0f;
  float strengths2 = 0.0f;
  float ambient = 0.0f;
  float smooth2 = 0.0f;
  float evidence = 0.0f;
  float moment = 0.0f;
  float disparities = 0.0f;
  float strongest = -1.0f;
  Match match;
  for (int y = -reach_v; y <= reach_v; ++y) {
    const int v = pixel.y + y;
    if (v < 0 || v >= windows.dots_dn.rows) continue;
    const float* dots = windows.dots_dn[v];
    const float* lights = windows.ambient_dn[v];
    const float* places = windows.disparity_px[v];
    for (int x = -reach_u; x <= reach_u; ++x) {
      const int u = pixel.x + x;
      if (u < 0 || u >= windows.dots_dn.cols) continue;
      const float weight = weights_u_[static_cast<size_t>(x + reach_u)] *
                           weights_v_[static_cast<size_t>(y + reach_v)];
      const float s = dots[u];
      weight_sum += weight;
      strengths += weight * s;
      strengths2 += weight * s * s;
      ambient += weight * lights[u];
      smooth2 += weight * Squared(mean * s + lights[u]);
      if (s <= 0.0f) continue;
      if (s > strongest) {
        strongest = s;
        match.strongest = {u, v};
      }
      const float apart = places[u] - disparity_px;
      const float fit = weight * s * std::exp(-apart * apart / (4.0f * spread2));
      evidence += fit;
      moment += fit * static_cast<float>(x);
      disparities += fit * places[u];
    }
  }
  if (evidence <= 0.0f) return match;
  const auto c2 = static_cast<float>(infrared_.speckle_contrast * infrared_.speckle_contrast);
  match.evidence = evidence / weight_sum;
  match.strength2 = strengths2 / weight_sum;
  const float smooth_mean = (mean * strengths + ambient) / weight_sum;
  const float smooth_variance = std::max(0.0f, smooth2 / weight_sum - smooth_mean * smooth_mean);
  const auto dark_variance =
      static_cast<float>(infrared_.dark_noise_dn * infrared_.dark_noise_dn + 1.0 / 12.0);
  const float noise_variance =
      dark_variance + static_cast<float>(infrared_.shot_noise_dn) * smooth_mean;
  const float signal_variance =
      (variance + c2 * (variance + mean * mean)) * match.strength2 + smooth_variance;
  const float explained = variance * match.evidence * match.evidence;
  match.noise_dn = std::sqrt(noise_variance);
  match.unexplained = signal_variance - explained;
  match.correlation = std::sqrt(explained / (signal_variance + noise_variance));
  match.off_centre_px = static_cast<float>(scale_) * moment / evidence;
  match.disparity_px = disparities / evidence;
  return match;
}

bool ParametricDepth::IsAccepted(const Match& match, float rival, const Noise& noise) const {
  const auto pixels = static_cast<float>(matching_.window_width_px * matching_.window_height_px);
  const float rho = match.correlation;
  const float measured = rho + (1.0f - rho * rho) / std::sqrt(pixels) * noise.evidence;
  if (measured < static_cast<float>(matching_.least_correlation)) return false;
  if (measured - rival < static_cast<float>(matching_.least_lead)) return false;
  const auto variance = static_cast<float>(pattern_.variance);
  const float explained = variance * match.evidence * match.evidence;
  if (match.unexplained <= static_cast<float>(matching_.most_unexplained) * explained) return true;
  // The centre's noise: that of a mean place over the window, weighted with noisy evidence.
  const auto width = static_cast<float>(matching_.window_width_px);
  const float by_noise_px =
      match.noise_dn / std::sqrt(explained) * width / std::sqrt(12.0f * pixels);
  const float spread_px = std::hypot(by_noise_px, static_cast<float>(noise_.lateral_noise_px));
  return std::abs(match.off_centre_px + spread_px * noise.lateral) <=
         static_cast<float>(matching_.most_off_centre) * width;
}

float ParametricDepth::Read(const Windows& windows, cv::Point pixel, const Noise& noise) const {
  const float own_px = windows.disparity_px(pixel);
  Match match = MatchAt(windows, pixel, own_px);
  float rival = -1.0f;
  const float strongest_px = windows.disparity_px(match.strongest);
  if (std::abs(strongest_px - own_px) > 1.0f) {
    Match other = MatchAt(windows, pixel, strongest_px);
    if (other.correlation > match.correlation) std::swap(match, other);
    rival = other.correlation;
  }
  if (!IsAccepted(match, rival, noise)) return kNaN;
  const auto temporal_px = static_cast<float>(noise_.temporal_disparity_noise_px) * match.noise_dn /
                           std::sqrt(match.strength2);
  return match.disparity_px + static_cast<float>(noise_.fixed_disparity_noise_px) * noise.fixed +
         temporal_px * noise.temporal;
}

DepthFrame ParametricDepth::Observe(const RayCaster& caster, const Lighting& lighting,
                                    const Pose& X_WB, double unit_m, const RandomStream& shot,
                                    const RandomStream& frame) const {
  const AovImages aovs =
      caster.CastAovs(rays_, X_WB, lighting, {.offsets_px = {}, .p_WP = X_WB * p_CP_});
  const Windows windows = Gather(aovs);
  const cv::Size size = aovs.depth_m.size();
  const cv::Size window(static_cast<int>(weights_u_.size()), static_cast<int>(weights_v_.size()));
  const cv::Mat1f evidence = WindowNoise(frame.Child("evidence"), size, window);
  const cv::Mat1f lateral = WindowNoise(frame.Child("lateral"), size, window);
  const cv::Mat1f fixed = WindowNoise(shot.Child("laser_speckle"), size, window);
  const cv::Mat1f temporal = WindowNoise(frame.Child("disparity"), size, window);
  const MissingReturn missing(infrared_, matching_, range_, rays_.camera(), p_CP_);
  const cv::Size reach(matching_.window_width_px / 2, matching_.window_height_px / 2);
  DepthFrame result{.depth = {.raw = cv::Mat1w::zeros(size), .unit_m = unit_m},
                    .no_return = cv::Mat1b::zeros(size)};
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const cv::Point pixel(u, v);
      // Windows leave the image where those of the whole infra-red image do.
      const bool is_inside =
          u * scale_ >= reach.width && u * scale_ + reach.width <= size.width * scale_ - 1.0 &&
          v * scale_ >= reach.height && v * scale_ + reach.height <= size.height * scale_ - 1.0;
      NoReturn reason = NoReturn::kNone;
      double z_m = 0.0;
      if (!std::isfinite(aovs.depth_m(pixel))) {
        reason = NoReturn::kNoSurface;
      } else if (!is_inside) {
        reason = NoReturn::kBorder;
      } else {
        const float disparity_px = Read(windows, pixel,
                                        {.evidence = evidence(pixel),
                                         .lateral = lateral(pixel),
                                         .fixed = fixed(pixel),
                                         .temporal = temporal(pixel)});
        if (std::isfinite(disparity_px)) {
          z_m = range_.Depth(static_cast<double>(disparity_px));
          if (z_m == 0.0) reason = NoReturn::kRange;
        } else {
          reason = missing.Reason(aovs, pixel);
        }
      }
      result.depth.raw(pixel) = static_cast<uint16_t>(std::lround(z_m / unit_m));
      result.no_return(pixel) = static_cast<unsigned char>(reason);
    }
  }
  return result;
}

}  // namespace fenestra
