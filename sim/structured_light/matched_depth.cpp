#include "sim/structured_light/matched_depth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

std::vector<float> Normals(const RandomStream& stream, size_t count) {
  std::vector<float> values(count);
  stream.FillNormals(values);
  return values;
}

// Light of dots and ambient light of a pixel [DN] if all of it had the view of one ray.
struct Ray {
  const AovImages& aovs;
  cv::Point place;  // In aovs.
  Eigen::Vector3d direction;
};
cv::Vec2f LightAlong(const InfraredResponse& response, const SampledPattern& pattern,
                     const Ray& ray, cv::Point pixel, double fx_px) {
  const InfraredLight light = response.LightAt(ray.aovs, ray.place, ray.direction);
  double dots_dn = 0.0;
  if (light.dot_dn > 0.0) {
    const double disparity_px =
        fx_px * response.p_CP().x() / static_cast<double>(ray.aovs.depth_m(ray.place));
    dots_dn = light.dot_dn * static_cast<double>(pattern.At(pixel.x - disparity_px, pixel.y));
  }
  return {static_cast<float>(dots_dn), static_cast<float>(light.ambient_dn)};
}

// Light of dots and ambient light at each pixel [DN].
cv::Mat2f GatheredLight(const InfraredResponse& response, const SampledPattern& pattern,
                        const InfraredRays& rays, const InfraredView& view) {
  const double fx_px = rays.camera().parameters().fx_px;
  cv::Mat2f light(rays.size());
  for (int v = 0; v < light.rows; ++v) {
    for (int u = 0; u < light.cols; ++u) {
      light(v, u) =
          LightAlong(response, pattern, {view.aovs, {u, v}, rays.RayAt(u, v)}, {u, v}, fx_px);
    }
  }
  for (const PixelParts& parts : view.parts) {
    for (size_t i = 0; i < parts.pixels.size(); ++i) {
      const cv::Point pixel = parts.pixels[i];
      cv::Vec2f sum(0.0f, 0.0f);
      for (int part = 0; part < PixelParts::kPerPixel; ++part) {
        const Eigen::Vector2d offset = PixelParts::OffsetOf(part);
        const Ray ray{parts.aovs, parts.PlaceOf(i, part),
                      rays.RayAt(pixel.x + offset.x(), pixel.y + offset.y())};
        sum += LightAlong(response, pattern, ray, pixel, fx_px);
      }
      light(pixel) = sum / static_cast<float>(PixelParts::kPerPixel);
    }
  }
  return light;
}

// The 10-bit image at a share of the longest exposure: at a surface of depth z a pixel in column u
// shows the pattern at u - f b/z. A pixel that an outline or a shadow crosses gets the mean of its
// parts' light. `surface`: the stream of this view's laser speckle; `noise`: that of this image's
// flicker and noise.
cv::Mat1w InfraredImage(const InfraredResponse& response, const SampledPattern& pattern,
                        const InfraredRays& rays, const InfraredView& view, double exposure,
                        const RandomStream& surface, const RandomStream& noise) {
  const InfraredOptions& o = response.options();
  const cv::Size size = rays.size();
  const auto count = static_cast<size_t>(size.area());
  const std::vector<float> fixed = Normals(surface, count);
  const std::vector<float> flicker = Normals(noise.Child("flicker"), count);
  const std::vector<float> deviates = Normals(noise, count);
  const GammaVariate fixed_speckle(o.speckle_contrast);
  const GammaVariate flickering_speckle(o.speckle_flicker);
  const cv::Mat2f light = GatheredLight(response, pattern, rays, view);
  cv::Mat1w image(size);
  size_t i = 0;
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u, ++i) {
      const cv::Vec2f& dots_and_ambient = light(v, u);
      const float speckle = fixed_speckle(fixed[i]) * flickering_speckle(flicker[i]);
      double dn =
          exposure * static_cast<double>(dots_and_ambient[0] * speckle + dots_and_ambient[1]);
      // Rounding adds its own part of the noise.
      const double variance = response.NoiseVariance(dn) - 1.0 / 12.0;
      dn += std::sqrt(variance) * static_cast<double>(deviates[i]);
      image(v, u) = static_cast<uint16_t>(std::lround(std::clamp(dn, 0.0, o.saturation_dn)));
    }
  }
  return image;
}

}  // namespace

MatchedDepth::MatchedDepth(const InfraredOptions& infrared, const PatternMatchingOptions& matching,
                           const CameraModel& depth, int scale, double baseline_m,
                           const DisparityRange& range, const RollingShutter& shutter)
    : matching_(Validated(matching)),
      range_(range),
      shutter_(shutter),
      depth_camera_(depth),
      layout_{.scale = scale, .reach = {matching.block_width_px / 2, matching.block_height_px / 2}},
      rays_(layout_.CameraOf(depth), layout_.ShutterOf(depth, shutter)),
      response_(infrared, rays_.camera(), {baseline_m, 0.0, 0.0}),
      pattern_(std::make_shared<const SampledPattern>(infrared.dot_sigma_px)),
      matcher_(std::make_shared<const PatternMatcher>(
          matching, *pattern_, rays_.size(), 0.0,
          matching.SearchEnd(range) * rays_.size().width / DisparityRange::kImageWidth)) {}

MatchedDepth MatchedDepth::WithUnit(const CameraModel& depth, const DisparityError& error) const {
  MatchedDepth unit = *this;
  unit.depth_camera_ = depth;
  unit.error_ = error;
  unit.rays_ = InfraredRays(layout_.CameraOf(depth), layout_.ShutterOf(depth, shutter_));
  unit.response_ = response_.WithCamera(unit.rays_.camera());
  return unit;
}

ExplainedDepth MatchedDepth::Observe(const RayCaster& caster, const Lighting& lighting,
                                     const Pose& X_WB, double unit_m, const RandomStream& shot,
                                     const RandomStream& image_noise) const {
  const InfraredView view = rays_.Cast(caster, X_WB, lighting, response_.p_CP());
  const double exposure = response_.Exposure(view.aovs);
  const cv::Mat1w infrared =
      InfraredImage(response_, *pattern_, rays_, view, exposure, shot.Child("laser_speckle"),
                    image_noise.Child("infrared_noise"));
  const PatternMatches matches = matcher_->Match(infrared, layout_.scale);
  const MissingReturn missing(response_, exposure, matching_, range_);
  const double to_640 = DisparityRange::kImageWidth / rays_.size().width;
  const cv::Size size(depth_camera_.width_px(), depth_camera_.height_px());
  ExplainedDepth result{.depth = {.raw = cv::Mat1w::zeros(size), .unit_m = unit_m},
                        .no_return = cv::Mat1b::zeros(size),
                        .infrared = infrared};
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const cv::Point pixel = layout_.CentreOf({u, v});
      double z_m = 0.0;
      NoReturn reason = NoReturn::kNone;
      if (std::isfinite(matches.disparity_px(pixel))) {
        const auto disparity_px =
            static_cast<float>(static_cast<double>(matches.disparity_px(pixel)) * to_640);
        z_m = range_.Depth(static_cast<double>(error_.Of(disparity_px, {u, v})));
        if (z_m == 0.0) reason = NoReturn::kRange;
      } else {
        reason = layout_.HasBlock({u, v}, depth_camera_) ? missing.Reason(view.aovs, pixel)
                                                         : NoReturn::kBorder;
      }
      result.depth.raw(v, u) = static_cast<uint16_t>(std::lround(z_m / unit_m));
      result.no_return(v, u) = static_cast<unsigned char>(reason);
    }
  }
  return result;
}

}  // namespace fenestra
