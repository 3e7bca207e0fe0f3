#include "sim/structured_light/matched_depth.h"

#include <cmath>

#include "core/io/input_error.h"
#include "sim/structured_light/explained_depth.h"

namespace fenestra {
namespace {

// The infra-red camera: each of its pixels `scale` u, v has the ray of the depth pixel u, v.
CameraModel ScaledUp(const CameraModel& depth, int scale) {
  CameraParameters parameters = depth.parameters();
  parameters.width_px *= scale;
  parameters.height_px *= scale;
  parameters.fx_px *= scale;
  parameters.fy_px *= scale;
  parameters.cx_px *= scale;
  parameters.cy_px *= scale;
  return CameraModel(parameters);
}

}  // namespace

MatchedDepth::MatchedDepth(const InfraredOptions& infrared, const PatternMatchingOptions& matching,
                           const CameraModel& depth, int scale, double baseline_m,
                           const DisparityRange& range, const RollingShutter& shutter)
    : matching_(matching),
      range_(range),
      scale_(scale),
      depth_size_(depth.width_px(), depth.height_px()),
      rays_(ScaledUp(depth, scale), shutter),
      response_(infrared, rays_.camera(), {baseline_m, 0.0, 0.0}),
      pattern_(infrared.dot_sigma_px),
      matcher_(matching, pattern_, rays_.size(), 0.0,
               matching.SearchEnd(range) * rays_.size().width / DisparityRange::kImageWidth) {}

cv::Mat1w MatchedDepth::ObserveInfrared(const RayCaster& caster, const Lighting& lighting,
                                        const Pose& X_WB, const RandomStream& shot,
                                        const RandomStream& image_noise) const {
  const InfraredView view = rays_.Cast(caster, X_WB, lighting, response_.p_CP());
  return InfraredImage(response_, pattern_, rays_, view, response_.Exposure(view.aovs),
                       shot.Child("laser_speckle"), image_noise.Child("infrared_noise"));
}

ExplainedDepth MatchedDepth::Observe(const RayCaster& caster, const Lighting& lighting,
                                     const Pose& X_WB, double unit_m, const RandomStream& shot,
                                     const RandomStream& image_noise) const {
  const InfraredView view = rays_.Cast(caster, X_WB, lighting, response_.p_CP());
  const double exposure = response_.Exposure(view.aovs);
  const cv::Mat1w infrared =
      InfraredImage(response_, pattern_, rays_, view, exposure, shot.Child("laser_speckle"),
                    image_noise.Child("infrared_noise"));
  const PatternMatches matches = matcher_.Match(infrared, scale_);
  const MissingReturn missing(response_, exposure, matching_, range_);
  const double to_640 = DisparityRange::kImageWidth / rays_.size().width;
  ExplainedDepth result{.depth = {.raw = cv::Mat1w::zeros(depth_size_), .unit_m = unit_m},
                        .no_return = cv::Mat1b::zeros(depth_size_),
                        .infrared = infrared};
  for (int v = 0; v < depth_size_.height; ++v) {
    for (int u = 0; u < depth_size_.width; ++u) {
      const cv::Point pixel(scale_ * u, scale_ * v);
      double z_m = 0.0;
      NoReturn reason = NoReturn::kNone;
      if (std::isfinite(matches.disparity_px(pixel))) {
        z_m = range_.Depth(static_cast<double>(matches.disparity_px(pixel)) * to_640);
        if (z_m == 0.0) reason = NoReturn::kRange;
      } else {
        reason = matches.correlation(pixel) <= -1.0f ? NoReturn::kBorder
                                                     : missing.Reason(view.aovs, pixel);
      }
      result.depth.raw(v, u) = static_cast<uint16_t>(std::lround(z_m / unit_m));
      result.no_return(v, u) = static_cast<unsigned char>(reason);
    }
  }
  return result;
}

}  // namespace fenestra
