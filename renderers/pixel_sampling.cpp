#include "renderers/pixel_sampling.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_error.h"
#include "renderers/edge_search.h"
#include "renderers/film.h"
#include "renderers/pixel_sampler.h"

namespace fenestra {
namespace {

// Few samples per pixel: packets of square blocks of pixels, cut at the image's border.
void SampleBlocks(const PixelSampler& sampler, int samples, const cv::Size& size, Film& film) {
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
      sampler.SampleSparsely(pixels, count, samples, film);
    }
  }
}

void SampleEdgePixel(const PixelSampler& sampler, int samples, Film::Pixel pixel, Film& film) {
  if (const auto found = SearchEdge(sampler, pixel)) {
    film.Set(pixel, *found);
  } else if (samples >= kLanes) {
    film.Set(pixel, sampler.SampleDensely(pixel, samples));
  } else {
    sampler.SampleSparsely({pixel}, 1, samples, film);
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
  const PixelSampler sampler(light, rays, camera, sampling.key());
  const cv::Size size(rays.width_px(), rays.height_px());
  Film film(size.width, size.height, light.channel_count());
  if (options.samples_per_pixel < kLanes) {
    SampleBlocks(sampler, options.samples_per_pixel, size, film);
  } else {
    for (int row = 0; row < size.height; ++row) {
      for (int column = 0; column < size.width; ++column) {
        film.Set({column, row}, sampler.SampleDensely({column, row}, options.samples_per_pixel));
      }
    }
  }
  if (options.edge_samples_per_pixel > options.samples_per_pixel) {
    const cv::Mat1b edges = film.Edges();
    for (int row = 0; row < size.height; ++row) {
      for (int column = 0; column < size.width; ++column) {
        if (edges(row, column) == 0) continue;
        SampleEdgePixel(sampler, options.edge_samples_per_pixel, {column, row}, film);
      }
    }
  }
  return film.TakeRadiance();
}

}  // namespace fenestra
