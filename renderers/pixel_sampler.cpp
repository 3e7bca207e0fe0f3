#include "renderers/pixel_sampler.h"

#include <algorithm>

namespace fenestra {
namespace {

Lanes<uint32_t> AllLanes(uint32_t value) {
  Lanes<uint32_t> lanes;
  lanes.v.fill(value);
  return lanes;
}

}  // namespace

PixelSampler::PixelSampler(const LightTransport& light, const RayGrid& rays,
                           const FloatPose& camera, uint64_t key)
    : light_(light),
      rays_(rays),
      camera_(camera),
      scramble_(key),
      stride_(static_cast<uint32_t>(rays.width_px()) + 1) {}

LightTransport::Arriving PixelSampler::TraceImagePoints(const LaneMask& mask,
                                                        const ImagePoints& points) const {
  RayPacket packet;
  SetRays(packet, camera_.p_WC, ToWorld(camera_.axes, points.x, points.y));
  return light_.Trace(mask, packet);
}

LightTransport::Arriving PixelSampler::Trace(Film::Pixel pixel, const PixelPoints& points) const {
  return TraceImagePoints(FirstLanes(kLanes), InPixels(rays_.corner_data(),
                                                       AllLanes(CornerOf(pixel)), stride_, points));
}

PixelPoints PixelSampler::SamplePoints(Film::Pixel pixel, int first) const {
  Lanes<uint32_t> net_x;
  Lanes<uint32_t> net_y;
  std::copy_n(&kNetTable.x[static_cast<size_t>(first)], kLanes, net_x.data());
  std::copy_n(&kNetTable.y[static_cast<size_t>(first)], kLanes, net_y.data());
  return ScrambledPoints(net_x, net_y, AllLanes(IndexOf(pixel)), scramble_);
}

Film::PixelResult PixelSampler::SampleDensely(Film::Pixel pixel, int samples) const {
  std::array<Lanes<float>, LightTransport::kMostChannels> sums{};
  Film::PixelResult result;
  for (int first = 0; first < samples; first += kLanes) {
    const LightTransport::Arriving arriving = Trace(pixel, SamplePoints(pixel, first));
    for (size_t c = 0; c < channel_count(); ++c) {
      for (int i = 0; i < kLanes; ++i) sums[c][i] += arriving.radiance[c][i];
    }
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

void PixelSampler::SampleSparsely(const std::array<Film::Pixel, kLanes>& pixels, int count,
                                  int samples, Film& film) const {
  Lanes<uint32_t> index;
  Lanes<uint32_t> corner;
  Lanes<uint32_t> net_x;
  Lanes<uint32_t> net_y;
  for (int i = 0; i < count * samples; ++i) {
    const Film::Pixel& pixel = pixels[static_cast<size_t>(i / samples)];
    index[i] = IndexOf(pixel);
    corner[i] = CornerOf(pixel);
    net_x[i] = kNetTable.x[static_cast<size_t>(i % samples)];
    net_y[i] = kNetTable.y[static_cast<size_t>(i % samples)];
  }
  const PixelPoints points = ScrambledPoints(net_x, net_y, index, scramble_);
  const LightTransport::Arriving arriving = TraceImagePoints(
      FirstLanes(count * samples), InPixels(rays_.corner_data(), corner, stride_, points));
  const float weight = 1.0f / static_cast<float>(samples);
  for (int p = 0; p < count; ++p) {
    const int first = p * samples;
    Film::PixelResult result;
    result.key = arriving.key[first];
    for (int i = first + 1; i < first + samples; ++i) {
      if (arriving.key[i] != arriving.key[first]) result.key = Film::kMixed;
    }
    for (size_t c = 0; c < channel_count(); ++c) {
      float sum = 0.0f;
      for (int i = first; i < first + samples; ++i) sum += arriving.radiance[c][i];
      result.radiance[c] = weight * sum;
    }
    film.Set(pixels[static_cast<size_t>(p)], result);
  }
}

}  // namespace fenestra
