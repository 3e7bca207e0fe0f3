#include "renderers/ray_caster.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/io/faults.h"
#include "renderers/aov_cast.h"
#include "renderers/light/illumination.h"
#include "renderers/light/light_transport.h"
#include "renderers/sampling/edge_search.h"
#include "renderers/sampling/film.h"
#include "renderers/sampling/pixel_sampler.h"

namespace fenestra {
namespace {

// Mean distance between the rays of neighbouring pixels, divided by the depth.
float Spread(const RayGrid& rays) {
  const Eigen::Vector2f across = rays.Corner(rays.width_px(), rays.height_px()) - rays.Corner(0, 0);
  return std::sqrt(std::abs(across.x() * across.y()) /
                   static_cast<float>(rays.width_px() * rays.height_px()));
}

void SampleEdgePixel(const PixelSampler& sampler, const RenderOptions& options, Film::Pixel pixel,
                     Film& film) {
  if (const auto found = SearchEdge(options.edge_lines, sampler, pixel, film.At(pixel))) {
    film.Set(pixel, *found);
  } else {
    film.Set(pixel, sampler.SampleQuarters(pixel, options.edge_samples_per_pixel));
  }
}

// The mean radiance of each pixel's area and of its quarters. All pixels get a few samples. If the
// samples of a pixel and its eight neighbours have seen different things, the edge between these
// is searched for (see SearchEdge); pixels with more than one edge get many samples.
//
// Sample i of a pixel is Sobol point i, scrambled (see sobol_samples.h) by a hash of the stream's
// key and the pixel's index. So samples of a pixel are stratified along x and along y, and the
// errors of different pixels are independent.
Film SampleImage(const LightTransport& light, const RayGrid& rays, const FloatPose& camera,
                 const RenderOptions& options, const RandomStream& sampling) {
  const PixelSampler sampler(light, rays, camera, sampling.key());
  const cv::Size size(rays.width_px(), rays.height_px());
  Film film(size.width, size.height, light.channel_count());
  if (options.samples_per_pixel < kLanes) {
    for (int row = 0; row < size.height; row += kBlockSide) {
      for (int column = 0; column < size.width; column += kBlockSide) {
        sampler.SampleBlock({column, row}, options.samples_per_pixel, film);
      }
    }
  } else {
    for (int row = 0; row < size.height; ++row) {
      for (int column = 0; column < size.width; ++column) {
        film.Set({column, row}, sampler.SampleDensely({column, row}, options.samples_per_pixel));
      }
    }
  }
  film.MarkEdges();
  if (options.edge_samples_per_pixel > options.samples_per_pixel) {
    const cv::Mat1b& edges = film.edges();
    for (int row = 0; row < size.height; ++row) {
      for (int column = 0; column < size.width; ++column) {
        if (edges(row, column) == 0) continue;
        SampleEdgePixel(sampler, options, {column, row}, film);
      }
    }
  }
  return film;
}

}  // namespace

void Validate(const RenderOptions& options) {
  Faults faults("render");
  const auto check = [&faults](const char* name, int samples) {
    faults.Require(samples == 1 || samples == 4 || samples == 16 || samples == 64 || samples == 256,
                   fmt::format("{} must be 1, 4, 16, 64 or 256, not {}", name, samples));
  };
  check("samples_per_pixel", options.samples_per_pixel);
  check("edge_samples_per_pixel", options.edge_samples_per_pixel);
  faults.Require(options.edge_samples_per_pixel >= options.samples_per_pixel,
                 fmt::format("edge_samples_per_pixel ({}) must not be less than "
                             "samples_per_pixel ({})",
                             options.edge_samples_per_pixel, options.samples_per_pixel));
  faults.ThrowIfAny();
}

void Validate(const RayCasterOptions& options) {
  if (options.bounces >= 0 && options.bounces <= 1000) return;
  throw InputError("ray caster",
                   fmt::format("bounces must be in 0 to 1000, not {}", options.bounces));
}

struct RayCaster::Impl {
  Impl(Scene&& the_scene, const RayCasterOptions& options)
      : scene(std::move(the_scene)),
        traced(scene, options.instruction_set),
        surfaces(NumberSurfaces(traced.opaque())),
        bake(BakeLight(traced, surfaces, options.most_light_points)),
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

RayCaster::RayCaster(Scene scene, const RayCasterOptions& options) {
  Validate(scene);
  Validate(options);
  impl_ = std::make_unique<Impl>(std::move(scene), options);
}

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
