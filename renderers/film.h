#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "renderers/light_transport.h"

namespace fenestra {

/// An image under construction, and what each of its pixels has seen.
class Film {
 public:
  struct Pixel {
    int column;
    int row;
  };

  /// The key of a pixel among whose samples are different ones; no side has this key.
  static constexpr uint32_t kMixed = ~0u;

  /// What the samples of one pixel told: their mean, and what they have seen.
  struct PixelResult {
    std::array<float, LightTransport::kMostChannels> radiance{};
    uint32_t key = 0;
  };

  Film(int width_px, int height_px, int channels);

  void Set(Pixel pixel, const PixelResult& result) {
    float* out = radiance_.ptr<float>(pixel.row) + pixel.column * channels_;
    for (int c = 0; c < channels_; ++c) out[c] = result.radiance[static_cast<size_t>(c)];
    keys_(pixel.row, pixel.column) = static_cast<int>(result.key);
  }

  PixelResult At(Pixel pixel) const {
    PixelResult result;
    const float* in = radiance_.ptr<float>(pixel.row) + pixel.column * channels_;
    for (int c = 0; c < channels_; ++c) result.radiance[static_cast<size_t>(c)] = in[c];
    result.key = static_cast<uint32_t>(keys_(pixel.row, pixel.column));
    return result;
  }

  /// 255 where a pixel or one of its eight neighbours is mixed, or a neighbour has seen something
  /// else: since samples may miss a corner that an edge cuts off, both sides of it count.
  cv::Mat1b Edges() const;

  /// The image; CV_32F with the film's channels.
  cv::Mat TakeRadiance() { return std::move(radiance_); }

 private:
  cv::Mat radiance_;
  cv::Mat1i keys_;
  int channels_;
};

}  // namespace fenestra
