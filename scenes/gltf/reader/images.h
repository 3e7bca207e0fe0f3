#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/io/faults.h"
#include "scenes/gltf/reader/asset.h"
#include "scenes/scene.h"

namespace fenestra::gltf {

/// The header of a PNG or JPEG file, read before anything is decompressed.
struct ImageHeader {
  enum class Format { kPng, kJpeg, kOther };
  Format format = Format::kOther;
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  /// Whether the file has its end mark, i.e. was not truncated.
  bool is_complete = false;
};

/// Reads the marks of the container only; never fails, as other formats are `kOther`.
ImageHeader ReadImageHeader(std::span<const uint8_t> bytes);

/// A decoded image: sRGB-encoded colours and linear alpha, row-major from the top left.
struct Picture {
  int width_px = 0;
  int height_px = 0;
  std::vector<glm::u8vec4> texels;
};

/// Checks the headers of all images of an asset, needed or not, against the limits and for
/// completeness. Images in formats of ignored extensions are not checked.
void CheckImages(const Asset& asset, Faults& faults);

/// The number of pixels that may still be decoded.
class PixelBudget {
 public:
  explicit PixelBudget(size_t pixels) : left_(pixels) {}
  [[nodiscard]] bool Take(size_t pixels) {
    if (pixels > left_) return false;
    left_ -= pixels;
    return true;
  }

 private:
  size_t left_;
};

/// Decodes PNG or JPEG to 8 bits a channel. Throws InputError for damaged data, for another format,
/// and beyond the budget, before anything is decompressed.
Picture DecodeImage(const Asset& asset, size_t image, PixelBudget& budget);

}  // namespace fenestra::gltf
