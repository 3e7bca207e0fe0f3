#include "sim/structured_light/infrared_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/io/faults.h"

namespace fenestra {
namespace {

// Landau's dot signal was fitted on a white wall.
constexpr double kReferenceReflectance = 0.8;

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
cv::Vec2f LightAlong(const InfraredOptions& o, const SampledPattern& pattern, const Ray& ray,
                     cv::Point pixel, double fx_px, const Eigen::Vector3d& p_CP) {
  const InfraredLight light = InfraredLightAt(o, ray.aovs, ray.place, ray.direction, p_CP);
  double dots_dn = 0.0;
  if (light.dot_dn > 0.0) {
    const double disparity_px = fx_px * p_CP.x() / ray.aovs.depth_m(ray.place);
    dots_dn = light.dot_dn * static_cast<double>(pattern.At(pixel.x - disparity_px, pixel.y));
  }
  return {static_cast<float>(dots_dn), static_cast<float>(light.ambient_dn)};
}

// Light of dots and ambient light at each pixel [DN].
cv::Mat2f GatheredLight(const InfraredOptions& o, const SampledPattern& pattern,
                        const InfraredRays& rays, const InfraredView& view,
                        const Eigen::Vector3d& p_CP) {
  const double fx_px = rays.camera().parameters().fx_px;
  cv::Mat2f light(rays.size());
  for (int v = 0; v < light.rows; ++v) {
    for (int u = 0; u < light.cols; ++u) {
      light(v, u) =
          LightAlong(o, pattern, {view.aovs, {u, v}, rays.RayAt(u, v)}, {u, v}, fx_px, p_CP);
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
        sum += LightAlong(o, pattern, ray, pixel, fx_px, p_CP);
      }
      light(pixel) = sum / static_cast<float>(PixelParts::kPerPixel);
    }
  }
  return light;
}

}  // namespace

void Validate(const InfraredOptions& o) {
  Faults faults("infra-red image");
  faults.Require(o.dot_irradiance > 0.0, "the dots' irradiance must be positive");
  faults.Require(o.dot_sigma_px >= 0.1 && o.dot_sigma_px <= 1.0,
                 "dots must spread over 0.1 to 1 px");
  faults.Require(o.dark_noise_dn >= 0.0 && o.shot_noise_dn >= 0.0 && o.speckle_contrast >= 0.0,
                 "noise must not be negative");
  faults.Require(o.saturation_dn >= 1.0 && o.saturation_dn <= 1023.0,
                 "saturation must lie between 1 and 1023 DN, of 10 bits");
  faults.ThrowIfAny();
}

InfraredLight InfraredLightAt(const InfraredOptions& o, const AovImages& aovs, cv::Point pixel,
                              const Eigen::Vector3d& ray, const Eigen::Vector3d& p_CP) {
  const double z_m = aovs.depth_m(pixel);
  if (!std::isfinite(z_m)) return {};
  const double reflected_dn =
      o.dot_signal_dn * aovs.reflectance_830nm(pixel) / kReferenceReflectance;
  const double T = aovs.transmittance(pixel);
  // The pattern passes a pane of glass twice; the irradiance is on the surface, behind the pane.
  InfraredLight light{.dot_dn = 0.0,
                      .ambient_dn = reflected_dn * T * aovs.irradiance_830(pixel) *
                                    o.filter_width_nm / o.dot_irradiance,
                      .cos_projector = 0.0};
  if (aovs.sees_point(pixel) != 0) {
    const Eigen::Vector3d to_projector = p_CP - z_m * ray;
    const cv::Vec3f& n = aovs.normal_C(pixel);
    const double distance2 = to_projector.squaredNorm();
    light.cos_projector =
        std::max(0.0, Eigen::Vector3d(n[0], n[1], n[2]).dot(to_projector) / std::sqrt(distance2));
    light.dot_dn = reflected_dn * light.cos_projector / distance2 * T * T;
  }
  return light;
}

cv::Mat1w InfraredImage(const InfraredOptions& o, const SampledPattern& pattern,
                        const InfraredRays& rays, const InfraredView& view,
                        const Eigen::Vector3d& p_CP, const RandomStream& surface,
                        const RandomStream& noise) {
  const cv::Size size = rays.size();
  const auto count = static_cast<size_t>(size.area());
  const std::vector<float> speckle = Normals(surface, count);
  const std::vector<float> deviates = Normals(noise, count);
  const cv::Mat2f light = GatheredLight(o, pattern, rays, view, p_CP);
  cv::Mat1w image(size);
  size_t i = 0;
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u, ++i) {
      const cv::Vec2f& dots_and_ambient = light(v, u);
      const double contrast = o.speckle_contrast * static_cast<double>(speckle[i]);
      double dn = static_cast<double>(dots_and_ambient[0]) * std::max(0.0, 1.0 + contrast) +
                  static_cast<double>(dots_and_ambient[1]);
      const double deviation = std::sqrt(o.dark_noise_dn * o.dark_noise_dn + o.shot_noise_dn * dn);
      dn += deviation * static_cast<double>(deviates[i]);
      image(v, u) = static_cast<uint16_t>(std::lround(std::clamp(dn, 0.0, o.saturation_dn)));
    }
  }
  return image;
}

}  // namespace fenestra
