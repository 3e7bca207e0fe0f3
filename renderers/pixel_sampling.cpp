#include "renderers/pixel_sampling.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_error.h"
#include "renderers/film.h"
#include "renderers/net_samples.h"

namespace fenestra {
namespace {

constexpr int kMostChannels = LightTransport::kMostChannels;

// An edge pixel whose first samples all see the same is left at these: the edge cuts off less than
// one part in 64, and so seldom that it does not count.
constexpr int kProbe = 64;

PixelPatch PatchOf(const RayGrid& rays, Film::Pixel pixel) {
  const Eigen::Vector2f& c00 = rays.Corner(pixel.column, pixel.row);
  const Eigen::Vector2f& c10 = rays.Corner(pixel.column + 1, pixel.row);
  const Eigen::Vector2f& c01 = rays.Corner(pixel.column, pixel.row + 1);
  const Eigen::Vector2f& c11 = rays.Corner(pixel.column + 1, pixel.row + 1);
  return {.x0 = c00.x(),
          .xs = c10.x() - c00.x(),
          .xt = c01.x() - c00.x(),
          .xst = (c11.x() - c01.x()) - (c10.x() - c00.x()),
          .y0 = c00.y(),
          .ys = c10.y() - c00.y(),
          .yt = c01.y() - c00.y(),
          .yst = (c11.y() - c01.y()) - (c10.y() - c00.y())};
}

class Sampler {
 public:
  Sampler(const LightTransport& light, const RayGrid& rays, const FloatPose& camera, uint64_t key)
      : light_(light), rays_(rays), camera_(camera), key_(key) {}

  // A multiple of 16 samples of one pixel; fewer if the first `probe` of them see only one thing.
  Film::PixelResult SampleDensely(Film::Pixel pixel, int samples, int probe) const {
    const PixelPatch patch = PatchOf(rays_, pixel);
    const NetPoint scramble = Scramble(pixel);
    std::array<Lanes<float>, kMostChannels> sums{};
    Film::PixelResult result;
    int taken = 0;
    while (taken < samples && !(taken >= probe && result.key != Film::kMixed)) {
      const int first = taken;
      const ImagePoints points =
          SamplePatch(patch, &kNetTable.x[static_cast<size_t>(first)],
                      &kNetTable.y[static_cast<size_t>(first)], scramble.x, scramble.y);
      const LightTransport::Arriving arriving = Trace(FirstLanes(kLanes), points);
      for (size_t c = 0; c < Channels(); ++c) {
        for (int i = 0; i < kLanes; ++i) sums[c][i] += arriving.radiance[c][i];
      }
      if (first == 0) result.key = arriving.key[0];
      for (int i = 0; i < kLanes; ++i) {
        if (arriving.key[i] != result.key) result.key = Film::kMixed;
      }
      taken += kLanes;
    }
    for (size_t c = 0; c < Channels(); ++c) {
      double sum = 0.0;
      for (int i = 0; i < kLanes; ++i) sum += static_cast<double>(sums[c][i]);
      result.radiance[c] = static_cast<float>(sum / taken);
    }
    return result;
  }

  // 1 or 4 samples of each of 16 or 4 pixels; the first `count` of them are wanted.
  std::array<Film::PixelResult, kLanes> SampleSparsely(
      const std::array<Film::Pixel, kLanes>& pixels, int count, int samples) const {
    ImagePoints points;
    for (int p = 0; p < count; ++p) {
      const PixelPatch patch = PatchOf(rays_, pixels[static_cast<size_t>(p)]);
      const NetPoint scramble = Scramble(pixels[static_cast<size_t>(p)]);
      for (int j = 0; j < samples; ++j) {
        const float s = ToUnit(OwenScrambled(kNetTable.x[static_cast<size_t>(j)], scramble.x));
        const float t = ToUnit(OwenScrambled(kNetTable.y[static_cast<size_t>(j)], scramble.y));
        const int i = p * samples + j;
        points.x[i] = patch.x0 + s * patch.xs + t * (patch.xt + s * patch.xst);
        points.y[i] = patch.y0 + s * patch.ys + t * (patch.yt + s * patch.yst);
      }
    }
    const LightTransport::Arriving arriving = Trace(FirstLanes(count * samples), points);
    const float weight = 1.0f / static_cast<float>(samples);
    std::array<Film::PixelResult, kLanes> results;
    for (int p = 0; p < count; ++p) {
      Film::PixelResult& result = results[static_cast<size_t>(p)];
      result.key = arriving.key[p * samples];
      for (int i = p * samples; i < (p + 1) * samples; ++i) {
        if (arriving.key[i] != result.key) result.key = Film::kMixed;
      }
      for (size_t c = 0; c < Channels(); ++c) {
        float sum = 0.0f;
        for (int i = p * samples; i < (p + 1) * samples; ++i) sum += arriving.radiance[c][i];
        result.radiance[c] = weight * sum;
      }
    }
    return results;
  }

 private:
  size_t Channels() const { return static_cast<size_t>(light_.channel_count()); }

  NetPoint Scramble(Film::Pixel pixel) const {
    return ScrambleOf(key_,
                      static_cast<uint64_t>(pixel.row) * static_cast<uint64_t>(rays_.width_px()) +
                          static_cast<uint64_t>(pixel.column));
  }

  LightTransport::Arriving Trace(const LaneMask& mask, const ImagePoints& points) const {
    RayPacket packet;
    SetRays(packet, camera_.p_WC, ToWorld(camera_.axes, points.x, points.y));
    return light_.Trace(mask, packet);
  }

  const LightTransport& light_;
  const RayGrid& rays_;
  const FloatPose& camera_;
  uint64_t key_;
};

// Few samples per pixel: packets of square blocks of pixels, cut at the image's border.
void SampleBlocks(const Sampler& sampler, int samples, const cv::Size& size, Film& film) {
  const int side = samples == 1 ? 4 : 2;
  for (int top = 0; top < size.height; top += side) {
    for (int left = 0; left < size.width; left += side) {
      std::array<Film::Pixel, kLanes> pixels;
      int count = 0;
      for (int row = top; row < std::min(top + side, size.height); ++row) {
        for (int column = left; column < std::min(left + side, size.width); ++column) {
          pixels[static_cast<size_t>(count++)] = {column, row};
        }
      }
      const auto results = sampler.SampleSparsely(pixels, count, samples);
      for (int p = 0; p < count; ++p) {
        film.Set(pixels[static_cast<size_t>(p)], results[static_cast<size_t>(p)]);
      }
    }
  }
}

void SamplePixel(const Sampler& sampler, int samples, int probe, Film::Pixel pixel, Film& film) {
  if (samples >= kLanes) {
    film.Set(pixel, sampler.SampleDensely(pixel, samples, probe));
  } else {
    film.Set(pixel, sampler.SampleSparsely({pixel}, 1, samples)[0]);
  }
}

}  // namespace

void Validate(const RenderOptions& options) {
  std::vector<InputFault> faults;
  const auto check = [&faults](const char* name, int samples) {
    if (samples == 1 || samples == 4 || samples == 16 || samples == 64 || samples == 256) return;
    faults.push_back(
        {"render", 0, 0, fmt::format("{} must be 1, 4, 16, 64 or 256, not {}", name, samples)});
  };
  check("samples_per_pixel", options.samples_per_pixel);
  check("edge_samples_per_pixel", options.edge_samples_per_pixel);
  if (options.edge_samples_per_pixel < options.samples_per_pixel) {
    faults.push_back({"render", 0, 0,
                      fmt::format("edge_samples_per_pixel ({}) must not be less than "
                                  "samples_per_pixel ({})",
                                  options.edge_samples_per_pixel, options.samples_per_pixel)});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

cv::Mat SampleImage(const LightTransport& light, const RayGrid& rays, const FloatPose& camera,
                    const RenderOptions& options, const RandomStream& sampling) {
  const Sampler sampler(light, rays, camera, sampling.key());
  const cv::Size size(rays.width_px(), rays.height_px());
  Film film(size.width, size.height, light.channel_count());
  if (options.samples_per_pixel < kLanes) {
    SampleBlocks(sampler, options.samples_per_pixel, size, film);
  } else {
    for (int row = 0; row < size.height; ++row) {
      for (int column = 0; column < size.width; ++column) {
        SamplePixel(sampler, options.samples_per_pixel, options.samples_per_pixel, {column, row},
                    film);
      }
    }
  }
  if (options.edge_samples_per_pixel > options.samples_per_pixel) {
    const cv::Mat1b edges = film.Edges();
    for (int row = 0; row < size.height; ++row) {
      for (int column = 0; column < size.width; ++column) {
        if (edges(row, column) == 0) continue;
        SamplePixel(sampler, options.edge_samples_per_pixel, kProbe, {column, row}, film);
      }
    }
  }
  return film.TakeRadiance();
}

}  // namespace fenestra
