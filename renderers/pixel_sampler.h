#pragma once

#include <array>

#include "renderers/film.h"
#include "renderers/light_transport.h"
#include "renderers/net_samples.h"
#include "renderers/ray_grid.h"

namespace fenestra {

/// Traces rays through places within the pixels of one image.
class PixelSampler {
 public:
  /// Keeps references to all arguments but the key.
  PixelSampler(const LightTransport& light, const RayGrid& rays, const FloatPose& camera,
               uint64_t key);

  size_t channel_count() const { return static_cast<size_t>(light_.channel_count()); }
  const ImageScramble& scramble() const { return scramble_; }
  uint32_t IndexOf(Film::Pixel pixel) const {
    return static_cast<uint32_t>(pixel.row * rays_.width_px() + pixel.column);
  }

  /// Sixteen places within one pixel.
  LightTransport::Arriving Trace(Film::Pixel pixel, const PixelPoints& points) const;

  /// Samples [first, first + 16) of a pixel.
  PixelPoints SamplePoints(Film::Pixel pixel, int first) const;

  /// The mean of `samples` samples, a multiple of 16.
  Film::PixelResult SampleDensely(Film::Pixel pixel, int samples) const;

  /// 1 or 4 samples of each of 16 or 4 pixels; the first `count` of them are wanted.
  void SampleSparsely(const std::array<Film::Pixel, kLanes>& pixels, int count, int samples,
                      Film& film) const;

 private:
  LightTransport::Arriving TraceImagePoints(const LaneMask& mask, const ImagePoints& points) const;
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
