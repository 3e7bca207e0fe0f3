#include "sim/structured_light/infrared_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

}  // namespace

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

}  // namespace fenestra
