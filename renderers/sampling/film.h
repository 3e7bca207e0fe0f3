#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "renderers/light/light_transport.h"
#include "renderers/tracing/render_types.h"

namespace fenestra {

/// An image under construction, with the key of what each of its pixels has seen.
class Film {
 public:
  struct Pixel {
    int column;
    int row;
  };

  /// The key of a pixel whose samples differ in their keys; no side has this key.
  static constexpr uint32_t kMixed = ~0u;

  using Radiance = std::array<float, LightTransport::kMostChannels>;

  /// The result of one pixel's samples: their mean, and the key of what they have seen.
  struct PixelResult {
    Radiance radiance{};
    uint32_t key = 0;
  };

  /// The result for each quarter of a pixel, in the order of QuarterImages.
  struct QuarteredResult {
    std::array<Radiance, 4> quarters{};
    uint32_t key = 0;
  };

  Film(int width_px, int height_px, int channels);

  void Set(Pixel pixel, const PixelResult& result) {
    float* out = radiance_.ptr<float>(pixel.row) + pixel.column * channels_;
    for (int c = 0; c < channels_; ++c) out[c] = result.radiance[static_cast<size_t>(c)];
    keys_(pixel.row, pixel.column) = static_cast<int>(result.key);
  }

  /// Sets the pixel to the mean of its quarters, and remembers them.
  void Set(Pixel pixel, const QuarteredResult& result);

  PixelResult At(Pixel pixel) const {
    PixelResult result;
    const float* in = radiance_.ptr<float>(pixel.row) + pixel.column * channels_;
    for (int c = 0; c < channels_; ++c) result.radiance[static_cast<size_t>(c)] = in[c];
    result.key = static_cast<uint32_t>(keys_(pixel.row, pixel.column));
    return result;
  }

  /// Marks the pixels that may contain an edge: 255 where a pixel or one of its eight neighbours is
  /// mixed, or where a neighbour has another key. Both sides count, since samples may miss a corner
  /// that an edge cuts off.
  void MarkEdges();
  const cv::Mat1b& edges() const { return edges_; }

  /// The image; CV_32F with the film's channels.
  cv::Mat TakeRadiance() { return std::move(radiance_); }

  /// The image in quarters of pixels: as they were set, elsewhere from the plane through the pixel
  /// and its neighbours, which is level next to an edge. Edges must have been marked.
  QuarterImages TakeQuarters() const;

 private:
  cv::Mat radiance_;
  cv::Mat1i keys_;
  cv::Mat1b edges_;
  std::vector<std::pair<Pixel, std::array<Radiance, 4>>> quartered_;
  int channels_;
};

}  // namespace fenestra
