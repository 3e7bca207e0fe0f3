#pragma once

#include <cstdint>
#include <span>

namespace fenestra::gltf {

/// What a PNG or JPEG file says of itself before anything is decompressed.
struct ImageHeader {
  enum class Format { kPng, kJpeg, kOther };
  Format format = Format::kOther;
  uint32_t width_px = 0;
  uint32_t height_px = 0;
  /// The file's end mark is there: it was not cut off.
  bool is_complete = false;
};

/// Reads the marks of the container only; never fails, as other formats are `kOther`.
ImageHeader ReadImageHeader(std::span<const uint8_t> bytes);

}  // namespace fenestra::gltf
