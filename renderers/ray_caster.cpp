#include "renderers/ray_caster.h"

#include "renderers/aov_cast.h"
#include "renderers/light_transport.h"
#include "renderers/pixel_sampling.h"
#include "renderers/sky_view.h"
#include "renderers/traced_scene.h"

namespace fenestra {

struct RayCaster::Impl {
  explicit Impl(const Scene& the_scene)
      : scene((Validate(the_scene), the_scene)),
        traced(scene),
        sky_views(BakeSkyViews(traced)),
        side_keys(MakeSideKeys(traced.opaque())) {}

  LightTransport::Surfaces Surfaces() const { return {scene, traced, sky_views, side_keys}; }

  Scene scene;
  TracedScene traced;
  std::vector<TriangleSkyView> sky_views;
  std::vector<uint32_t> side_keys;
};

RayCaster::RayCaster(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}

RayCaster::~RayCaster() = default;

const Scene& RayCaster::scene() const {
  return impl_->scene;
}

cv::Mat RayCaster::Render(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                          const RenderOptions& options, const RandomStream& sampling) const {
  Validate(lighting);
  Validate(options);
  const FloatPose camera = ToFloat(X_WC);
  const LightTransport light(impl_->Surfaces(), lighting, ChannelsOf(options.band), camera.p_WC);
  return SampleImage(light, rays, camera, options, sampling);
}

AovImages RayCaster::CastAovs(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                              const AovOptions& options) const {
  Validate(lighting);
  return CastAovImages(impl_->Surfaces(), rays, X_WC, lighting, options);
}

}  // namespace fenestra
