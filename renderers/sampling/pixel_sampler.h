#pragma once

#include <array>

#include "renderers/light/light_transport.h"
#include "renderers/sampling/film.h"
#include "renderers/tracing/ray_grid.h"
#include "renderers/tracing/sobol_samples.h"

namespace fenestra {

/// Traces rays through places within the pixels of one image.
class PixelSampler {
 public:
  /// Keeps references to all arguments but the key.
  PixelSampler(const LightTransport& light, const RayGrid& rays, const FloatPose& camera,
               uint64_t key);

  size_t channel_count() const { return static_cast<size_t>(light_.channel_count()); }

  /// The scrambling seeds of a pixel.
  SobolPoint SeedsOf(Film::Pixel pixel) const { return scramble_.OfPixel(IndexOf(pixel)); }

  /// The same pixel in all lanes.
  PixelPatches PatchOf(Film::Pixel pixel) const;

  LightTransport::Arriving Trace(const PixelPatches& patches, const PixelPoints& points,
                                 const LightTransport::SunRays& sun_rays = {}) const {
    return Trace(FirstLanes(kLanes), patches, points, sun_rays);
  }

  /// Samples [first, first + 16) of a pixel.
  PixelPoints SamplePoints(Film::Pixel pixel, int first) const;

  /// The mean of `samples` samples, a multiple of 16.
  Film::PixelResult SampleDensely(Film::Pixel pixel, int samples) const;

  /// The mean of each quarter of a pixel over `samples` samples of the pixel: 4, 16, 64 or 256, of
  /// which equally many fall on each quarter.
  Film::QuarteredResult SampleQuarters(Film::Pixel pixel, int samples) const;

  /// Takes `samples` samples of each pixel of the block with this top left pixel that is in the
  /// image.
  void SampleBlock(Film::Pixel top_left, int samples, Film& film) const;

  /// The mean of `samples` samples of one pixel, fewer than a packet.
  Film::PixelResult SampleSparsely(Film::Pixel pixel, int samples) const;

 private:
  LightTransport::Arriving Trace(const LaneMask& mask, const PixelPatches& patches,
                                 const PixelPoints& points,
                                 const LightTransport::SunRays& sun_rays = {}) const;
  // For the packet of samples from `first` on. Many samples see the sun's disc together.
  static LightTransport::SunRays SunRaysOf(int samples, int first) {
    constexpr int kMany = 64;
    return {.one_point = samples >= kMany, .packet = first / kLanes};
  }
  uint32_t IndexOf(Film::Pixel pixel) const {
    return static_cast<uint32_t>(pixel.row * rays_.width_px() + pixel.column);
  }
  uint32_t CornerOf(Film::Pixel pixel) const {
    return static_cast<uint32_t>(pixel.row) * stride_ + static_cast<uint32_t>(pixel.column);
  }

  const LightTransport& light_;
  const RayGrid& rays_;
  const FloatPose& camera_;
  ImageScramble scramble_;
  uint32_t stride_;
};

}  // namespace fenestra
