#include "renderers/ray_caster.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/input_error.h"
#include "renderers/aov_cast.h"
#include "renderers/light/illumination.h"
#include "renderers/light/light_transport.h"
#include "renderers/sampling/sample_image.h"

namespace fenestra {
namespace {

// Mean distance between the rays of neighbouring pixels, divided by the depth.
float Spread(const RayGrid& rays) {
  const Eigen::Vector2f across = rays.Corner(rays.width_px(), rays.height_px()) - rays.Corner(0, 0);
  return std::sqrt(std::abs(across.x() * across.y()) /
                   static_cast<float>(rays.width_px() * rays.height_px()));
}

}  // namespace

void Validate(const RayCasterOptions& options) {
  if (options.bounces >= 0 && options.bounces <= 1000) return;
  throw InputError("ray caster",
                   fmt::format("bounces must be in 0 to 1000, not {}", options.bounces));
}

struct RayCaster::Impl {
  Impl(const Scene& the_scene, const RayCasterOptions& options)
      : scene(Validated(the_scene)),
        traced(scene, options.instruction_set),
        surfaces(NumberSurfaces(traced.opaque())),
        bake(BakeLight(traced, surfaces)),
        side_keys(MakeSideKeys(surfaces)),
        illumination(scene, traced, bake, options.bounces) {}

  LightTransport Light(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                       const std::vector<Channel>& channels) const {
    return LightTransport({scene, traced, bake, side_keys}, illumination.Ambient(lighting),
                          lighting, channels, {.p_WC = ToFloat(X_WC).p_WC, .spread = Spread(rays)});
  }

  Scene scene;
  TracedScene traced;
  std::vector<uint32_t> surfaces;
  LightBake bake;
  std::vector<uint32_t> side_keys;
  Illumination illumination;
};

RayCaster::RayCaster(const Scene& scene, const RayCasterOptions& options)
    : impl_(std::make_unique<Impl>(scene, Validated(options))) {}

RayCaster::~RayCaster() = default;

const Scene& RayCaster::scene() const {
  return impl_->scene;
}

cv::Mat RayCaster::Render(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                          const RenderOptions& options, const RandomStream& sampling) const {
  Validate(lighting);
  Validate(options);
  const LightTransport light = impl_->Light(rays, X_WC, lighting, ChannelsOf(options.band));
  return SampleImage(light, rays, ToFloat(X_WC), options, sampling).TakeRadiance();
}

QuarterImages RayCaster::RenderQuarters(const RayGrid& rays, const Pose& X_WC,
                                        const Lighting& lighting, const RenderOptions& options,
                                        const RandomStream& sampling) const {
  Validate(lighting);
  Validate(options);
  const LightTransport light = impl_->Light(rays, X_WC, lighting, ChannelsOf(options.band));
  return SampleImage(light, rays, ToFloat(X_WC), options, sampling).TakeQuarters();
}

AovImages RayCaster::CastAovs(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                              const AovOptions& options) const {
  Validate(lighting);
  const LightTransport light =
      impl_->Light(rays, X_WC, lighting, {Channel::kIlluminance, Channel::kIrradiance830});
  return CastAovImages(impl_->scene, impl_->traced, light, rays, X_WC, options);
}

}  // namespace fenestra
