#include "renderers/sampling/sample_image.h"

#include "renderers/sampling/edge_search.h"
#include "renderers/sampling/film.h"
#include "renderers/sampling/pixel_sampler.h"

namespace fenestra {
namespace {

void SampleEdgePixel(const PixelSampler& sampler, const RenderOptions& options, Film::Pixel pixel,
                     Film& film) {
  if (const auto found = SearchEdge(options.edge_lines, sampler, pixel, film.At(pixel))) {
    film.Set(pixel, *found);
  } else {
    film.Set(pixel, sampler.SampleQuarters(pixel, options.edge_samples_per_pixel));
  }
}

}  // namespace

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

}  // namespace fenestra
