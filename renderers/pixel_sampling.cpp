#include "renderers/pixel_sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/input_error.h"
#include "renderers/net_samples.h"

namespace fenestra {
namespace {

constexpr int kMostChannels = LightTransport::kMostChannels;

// Among its samples a pixel has seen different things. No side has this key.
constexpr uint32_t kMixed = ~0u;

struct Pixel {
  int column;
  int row;
};

// What the samples of one pixel told: their mean, and what they have seen.
struct PixelResult {
  std::array<float, kMostChannels> radiance{};
  uint32_t key = 0;
};

PixelPatch PatchOf(const RayGrid& rays, Pixel pixel) {
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

  // A multiple of 16 samples of one pixel.
  PixelResult SampleDensely(Pixel pixel, int samples) const {
    const PixelPatch patch = PatchOf(rays_, pixel);
    const NetPoint scramble = Scramble(pixel);
    std::array<Lanes<float>, kMostChannels> sums{};
    PixelResult result;
    for (int first = 0; first < samples; first += kLanes) {
      const ImagePoints points =
          SamplePatch(patch, &kNetTable.x[static_cast<size_t>(first)],
                      &kNetTable.y[static_cast<size_t>(first)], scramble.x, scramble.y);
      const LightTransport::Arriving arriving = Trace(FirstLanes(kLanes), points);
      for (size_t c = 0; c < Channels(); ++c) {
        for (int i = 0; i < kLanes; ++i) sums[c][i] += arriving.radiance[c][i];
      }
      if (first == 0) result.key = arriving.key[0];
      for (int i = 0; i < kLanes; ++i) {
        if (arriving.key[i] != result.key) result.key = kMixed;
      }
    }
    for (size_t c = 0; c < Channels(); ++c) {
      double sum = 0.0;
      for (int i = 0; i < kLanes; ++i) sum += static_cast<double>(sums[c][i]);
      result.radiance[c] = static_cast<float>(sum / samples);
    }
    return result;
  }

  // 1 or 4 samples of each of 16 or 4 pixels; the first `count` of them are wanted.
  std::array<PixelResult, kLanes> SampleSparsely(const std::array<Pixel, kLanes>& pixels, int count,
                                                 int samples) const {
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
    std::array<PixelResult, kLanes> results;
    for (int p = 0; p < count; ++p) {
      PixelResult& result = results[static_cast<size_t>(p)];
      result.key = arriving.key[p * samples];
      for (int i = p * samples; i < (p + 1) * samples; ++i) {
        if (arriving.key[i] != result.key) result.key = kMixed;
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

  NetPoint Scramble(Pixel pixel) const {
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

// The image under construction, and what each pixel has seen.
class Film {
 public:
  Film(int width_px, int height_px, int channels)
      : radiance_(height_px, width_px, CV_MAKETYPE(CV_32F, channels)),
        keys_(height_px, width_px),
        channels_(channels) {}

  void Set(Pixel pixel, const PixelResult& result) {
    float* out = radiance_.ptr<float>(pixel.row) + pixel.column * channels_;
    for (int c = 0; c < channels_; ++c) out[c] = result.radiance[static_cast<size_t>(c)];
    keys_(pixel.row, pixel.column) = static_cast<int>(result.key);
  }

  // 255 where a pixel or one of its eight neighbours is mixed or has seen something else.
  cv::Mat1b Edges() const {
    const int mixed = static_cast<int>(kMixed);
    cv::Mat1b meets(keys_.size(), uchar{0});
    for (int row = 0; row < keys_.rows; ++row) {
      for (int column = 0; column < keys_.cols; ++column) {
        const int key = keys_(row, column);
        if (key == mixed) {
          MarkAround(meets, {column, row});
          continue;
        }
        // The neighbours before this pixel; those after it will look back.
        for (const auto& [dx, dy] : {std::pair{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
          const int x = column + dx;
          const int y = row + dy;
          if (x < 0 || y < 0 || x >= keys_.cols || keys_(y, x) == key) continue;
          meets(row, column) = 255;
          meets(y, x) = 255;
        }
      }
    }
    return meets;
  }

  cv::Mat TakeRadiance() { return std::move(radiance_); }

 private:
  static void MarkAround(cv::Mat1b& marks, Pixel pixel) {
    const cv::Rect around(pixel.column - 1, pixel.row - 1, 3, 3);
    marks(around & cv::Rect(0, 0, marks.cols, marks.rows)) = uchar{255};
  }

  cv::Mat radiance_;
  cv::Mat1i keys_;
  int channels_;
};

// Few samples per pixel: packets of square blocks of pixels, cut at the image's border.
void SampleBlocks(const Sampler& sampler, int samples, const cv::Size& size, Film& film) {
  const int side = samples == 1 ? 4 : 2;
  for (int top = 0; top < size.height; top += side) {
    for (int left = 0; left < size.width; left += side) {
      std::array<Pixel, kLanes> pixels;
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

void SamplePixel(const Sampler& sampler, int samples, Pixel pixel, Film& film) {
  if (samples >= kLanes) {
    film.Set(pixel, sampler.SampleDensely(pixel, samples));
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
        SamplePixel(sampler, options.samples_per_pixel, {column, row}, film);
      }
    }
  }
  if (options.edge_samples_per_pixel > options.samples_per_pixel) {
    const cv::Mat1b edges = film.Edges();
    for (int row = 0; row < size.height; ++row) {
      for (int column = 0; column < size.width; ++column) {
        if (edges(row, column) == 0) continue;
        SamplePixel(sampler, options.edge_samples_per_pixel, {column, row}, film);
      }
    }
  }
  return film.TakeRadiance();
}

}  // namespace fenestra
