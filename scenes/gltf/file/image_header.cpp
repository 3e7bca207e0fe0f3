#include "scenes/gltf/file/image_header.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace fenestra::gltf {
namespace {

using Span = std::span<const uint8_t>;

constexpr std::array<uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

uint32_t BigEndian32(Span at) {
  return (uint32_t{at[0]} << 24) | (uint32_t{at[1]} << 16) | (uint32_t{at[2]} << 8) |
         uint32_t{at[3]};
}

uint32_t BigEndian16(Span at) {
  return (uint32_t{at[0]} << 8) | uint32_t{at[1]};
}

// A PNG file is a row of chunks: length, type, data, checksum; IHDR first, IEND last.
ImageHeader ReadPng(Span bytes) {
  ImageHeader header{.format = ImageHeader::Format::kPng};
  constexpr size_t kOverhead = 12;
  size_t at = kPngSignature.size();
  while (bytes.size() - at >= kOverhead) {
    const size_t length = BigEndian32(bytes.subspan(at));
    if (length > bytes.size() - at - kOverhead) return header;
    const std::string_view type(reinterpret_cast<const char*>(&bytes[at + 4]), 4);
    if (at == kPngSignature.size()) {
      if (type != "IHDR" || length < 8) return header;
      header.width_px = BigEndian32(bytes.subspan(at + 8));
      header.height_px = BigEndian32(bytes.subspan(at + 12));
    }
    if (type == "IEND") {
      header.is_complete = true;
      return header;
    }
    at += kOverhead + length;
  }
  return header;
}

// Start-of-frame markers hold the size; the others of 0xC0 to 0xCF are tables.
bool IsStartOfFrame(uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

bool EndsWithEndOfImage(Span bytes) {
  constexpr std::array<uint8_t, 2> kEndOfImage = {0xFF, 0xD9};
  return std::search(bytes.begin(), bytes.end(), kEndOfImage.begin(), kEndOfImage.end()) !=
         bytes.end();
}

// A JPEG file is a row of segments, 0xFF and a marker and mostly a length, up to the scan.
ImageHeader ReadJpeg(Span bytes) {
  ImageHeader header{.format = ImageHeader::Format::kJpeg};
  size_t at = 2;
  while (bytes.size() - at >= 4) {
    if (bytes[at] != 0xFF) return header;
    const uint8_t marker = bytes[at + 1];
    if (marker == 0xFF) {  // Padding.
      ++at;
      continue;
    }
    const size_t length = BigEndian16(bytes.subspan(at + 2));
    if (length < 2 || length > bytes.size() - at - 2) return header;
    if (IsStartOfFrame(marker) && length >= 7) {
      header.height_px = BigEndian16(bytes.subspan(at + 5));
      header.width_px = BigEndian16(bytes.subspan(at + 7));
    }
    at += 2 + length;
    if (marker == 0xDA) {
      header.is_complete = EndsWithEndOfImage(bytes.subspan(at));
      return header;
    }
  }
  return header;
}

}  // namespace

ImageHeader ReadImageHeader(std::span<const uint8_t> bytes) {
  if (bytes.size() > kPngSignature.size() &&
      std::ranges::equal(kPngSignature, bytes.first(kPngSignature.size()))) {
    return ReadPng(bytes);
  }
  if (bytes.size() > 4 && bytes[0] == 0xFF && bytes[1] == 0xD8) return ReadJpeg(bytes);
  return {};
}

}  // namespace fenestra::gltf
