#include "renderers/sampling/pixel_sampler.h"

#include <algorithm>

#include "core/system/wide.h"

namespace fenestra {
namespace {

FENESTRA_WIDE void Accumulate(const Lanes<float>& values, Lanes<float>& sums) {
  for (int i = 0; i < kLanes; ++i) sums[i] += values[i];
}

FENESTRA_WIDE void MixKeys(const Lanes<uint32_t>& keys, Lanes<uint32_t>& kept) {
  for (int i = 0; i < kLanes; ++i) kept[i] = keys[i] == kept[i] ? kept[i] : Film::kMixed;
}

}  // namespace

PixelSampler::PixelSampler(const LightTransport& light, const RayGrid& rays,
                           const FloatPose& camera, uint64_t key)
    : light_(light),
      rays_(rays),
      camera_(camera),
      scramble_(key),
      stride_(static_cast<uint32_t>(rays.width_px()) + 1) {}

LightTransport::Arriving PixelSampler::Trace(const LaneMask& mask, const PixelPatches& patches,
                                             const PixelPoints& points,
                                             const LightTransport::SunRays& sun_rays) const {
  const ImagePoints image = InPixels(patches, points);
  RayPacket packet;
  SetRays(packet, camera_.p_WC, ToWorld(camera_.axes, image.x, image.y));
  return light_.Trace(mask, packet, sun_rays);
}

PixelPatches PixelSampler::PatchOf(Film::Pixel pixel) const {
  return PatchesOf(rays_.corner_data(), AllLanes(CornerOf(pixel)), stride_);
}

PixelPoints PixelSampler::SamplePoints(Film::Pixel pixel, int first) const {
  Lanes<uint32_t> net_x;
  Lanes<uint32_t> net_y;
  std::copy_n(&kSobolTable.x[static_cast<size_t>(first)], kLanes, net_x.data());
  std::copy_n(&kSobolTable.y[static_cast<size_t>(first)], kLanes, net_y.data());
  const SobolPoint seeds = SeedsOf(pixel);
  return ScrambledPoints(net_x, net_y, AllLanes(seeds.x), AllLanes(seeds.y));
}

Film::PixelResult PixelSampler::SampleDensely(Film::Pixel pixel, int samples) const {
  const PixelPatches patch = PatchOf(pixel);
  std::array<Lanes<float>, LightTransport::kMostChannels> sums{};
  Film::PixelResult result;
  for (int first = 0; first < samples; first += kLanes) {
    const LightTransport::Arriving arriving =
        Trace(patch, SamplePoints(pixel, first), SunRaysOf(samples, first));
    for (size_t c = 0; c < channel_count(); ++c) Accumulate(arriving.radiance[c], sums[c]);
    if (first == 0) result.key = arriving.key[0];
    for (int i = 0; i < kLanes; ++i) {
      if (arriving.key[i] != result.key) result.key = Film::kMixed;
    }
  }
  for (size_t c = 0; c < channel_count(); ++c) {
    double sum = 0.0;
    for (int i = 0; i < kLanes; ++i) sum += static_cast<double>(sums[c][i]);
    result.radiance[c] = static_cast<float>(sum / samples);
  }
  return result;
}

Film::PixelResult PixelSampler::SampleSparsely(Film::Pixel pixel, int samples) const {
  const LightTransport::Arriving arriving =
      Trace(FirstLanes(samples), PatchOf(pixel), SamplePoints(pixel, 0));
  Film::PixelResult result;
  result.key = arriving.key[0];
  for (int i = 0; i < samples; ++i) {
    if (arriving.key[i] != result.key) result.key = Film::kMixed;
    for (size_t c = 0; c < channel_count(); ++c) result.radiance[c] += arriving.radiance[c][i];
  }
  for (float& radiance : result.radiance) radiance /= static_cast<float>(samples);
  return result;
}

Film::QuarteredResult PixelSampler::SampleQuarters(Film::Pixel pixel, int samples) const {
  const PixelPatches patch = PatchOf(pixel);
  Film::QuarteredResult result;
  for (int first = 0; first < samples; first += kLanes) {
    const int lanes = std::min(samples, kLanes);
    const PixelPoints points = SamplePoints(pixel, first);
    const LightTransport::Arriving arriving =
        Trace(FirstLanes(lanes), patch, points, SunRaysOf(samples, first));
    if (first == 0) result.key = arriving.key[0];
    for (int i = 0; i < lanes; ++i) {
      if (arriving.key[i] != result.key) result.key = Film::kMixed;
      const size_t q = (points.t[i] < 0.5f ? 0 : 2) + (points.s[i] < 0.5f ? 0 : 1);
      for (size_t c = 0; c < channel_count(); ++c) {
        result.quarters[q][c] += arriving.radiance[c][i];
      }
    }
  }
  for (Film::Radiance& quarter : result.quarters) {
    for (float& radiance : quarter) radiance *= 4.0f / static_cast<float>(samples);
  }
  return result;
}

void PixelSampler::SampleBlock(Film::Pixel top_left, int samples, Film& film) const {
  const int columns = std::min(kBlockSide, rays_.width_px() - top_left.column);
  const int rows = std::min(kBlockSide, rays_.height_px() - top_left.row);
  if (columns < kBlockSide || rows < kBlockSide) {
    for (int row = top_left.row; row < top_left.row + rows; ++row) {
      for (int column = top_left.column; column < top_left.column + columns; ++column) {
        film.Set({column, row}, SampleSparsely({column, row}, samples));
      }
    }
    return;
  }
  const PixelBlock block = MakePixelBlock(CornerOf(top_left), stride_, IndexOf(top_left),
                                          static_cast<uint32_t>(rays_.width_px()), scramble_);
  const PixelPatches patches = PatchesOf(rays_.corner_data(), block.corner, stride_);
  const LaneMask all = FirstLanes(kLanes);
  LightTransport::Arriving sums;
  for (int sample = 0; sample < samples; ++sample) {
    const auto j = static_cast<size_t>(sample);
    const LightTransport::Arriving arriving =
        Trace(all, patches,
              ScrambledPoints(AllLanes(kSobolTable.x[j]), AllLanes(kSobolTable.y[j]), block.seed_x,
                              block.seed_y),
              {.packet = sample});
    if (sample == 0) {
      sums = arriving;
      continue;
    }
    for (size_t c = 0; c < channel_count(); ++c) {
      Accumulate(arriving.radiance[c], sums.radiance[c]);
    }
    MixKeys(arriving.key, sums.key);
  }
  const float weight = 1.0f / static_cast<float>(samples);
  for (int i = 0; i < kLanes; ++i) {
    Film::PixelResult result;
    result.key = sums.key[i];
    for (size_t c = 0; c < channel_count(); ++c) result.radiance[c] = weight * sums.radiance[c][i];
    film.Set({top_left.column + i % kBlockSide, top_left.row + i / kBlockSide}, result);
  }
}

}  // namespace fenestra
