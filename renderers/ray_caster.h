#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>

#include "core/geometry/pose.h"
#include "core/random/random_stream.h"
#include "renderers/tracing/ray_grid.h"
#include "renderers/tracing/render_types.h"
#include "scenes/lighting.h"
#include "scenes/scene.h"

namespace fenestra {

/// Throws InputError, with all faults, unless the sample counts are allowed ones.
void Validate(const RenderOptions& options);

struct RayCasterOptions {
  /// Number of diffuse reflections that light undergoes before it reaches what is seen. The light
  /// that is left out is at most ρ^(bounces + 1) of all light in a closed room of reflectance ρ.
  int bounces = 16;
  /// Number of points at which the light that arrives is computed, by vertex and side. Larger
  /// scenes have it at these many places, so that their cost is bounded: see BakeLight.
  size_t most_light_points = SIZE_MAX;
  /// Instruction set that Embree may use. Fenestra's own kernels round alike on all of them, but
  /// Embree's hits differ in their last bits. See docs/performance.md.
  InstructionSet instruction_set = InstructionSet::kBest;
};

/// Throws InputError unless bounces is in [0, 1000].
void Validate(const RayCasterOptions& options);

/// An Embree ray caster for one scene. Construction builds the ray tracing structures and bakes
/// what every vertex sees of the sky, of the ground and of other surfaces; everything else depends
/// on the arguments of the calls. Const calls are thread-safe and single-threaded inside.
class RayCaster {
 public:
  explicit RayCaster(Scene scene, const RayCasterOptions& options = {});
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  const Scene& scene() const;

  /// Mean radiance over each pixel's area; CV_32FC1 or CV_32FC3, linear in each light. X_WC places
  /// the camera. `sampling` scrambles the sample positions within the pixels.
  cv::Mat Render(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                 const RenderOptions& options, const RandomStream& sampling) const;

  /// Mean radiance over each quarter of each pixel, for a point spread that is narrower than a
  /// pixel: it blurs the light before pixels integrate it, which cannot be computed from whole
  /// pixels.
  QuarterImages RenderQuarters(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                               const RenderOptions& options, const RandomStream& sampling) const;

  AovImages CastAovs(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                     const AovOptions& options) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fenestra
