#include "scenes/gltf/reader/images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
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

constexpr uint32_t kLargestSide = 16384;

// The fault of an image, or nullopt if it has none.
std::optional<std::string> FaultOf(const ImageHeader& header) {
  if (header.format == ImageHeader::Format::kOther) return "not a PNG or JPEG image";
  if (header.width_px > kLargestSide || header.height_px > kLargestSide) {
    return fmt::format("{} x {} pixels; at most {} a side are read", header.width_px,
                       header.height_px, kLargestSide);
  }
  if (!header.is_complete) return "the image is cut off";
  if (header.width_px == 0 || header.height_px == 0) return "an image without pixels";
  return std::nullopt;
}

std::string PointerTo(size_t image) {
  return fmt::format("/images/{}", image);
}

[[noreturn]] void Refuse(const Asset& asset, size_t image, const std::string& reason) {
  throw InputError(asset.file, PointerTo(image) + ": " + reason);
}

cv::Mat Decode(const Asset& asset, size_t image) {
  cv::Mat decoded;
  try {
    decoded = cv::imdecode(asset.images[image], cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    decoded.release();
  }
  if (decoded.empty()) Refuse(asset, image, "the image is damaged");
  return decoded;
}

// Converts to 8 bits a channel, in the order red, green, blue, alpha.
cv::Mat4b ToRgba(const Asset& asset, size_t image, const cv::Mat& decoded) {
  cv::Mat narrow = decoded;
  if (decoded.depth() == CV_16U) decoded.convertTo(narrow, CV_8U, 1.0 / 257.0);
  const int channels = narrow.channels();
  if (narrow.depth() != CV_8U || (channels != 1 && channels != 3 && channels != 4)) {
    Refuse(asset, image,
           fmt::format("{} channel(s) of {} bits are not read", channels, 8 * decoded.elemSize1()));
  }
  cv::Mat4b rgba(narrow.size(), cv::Vec4b(255, 255, 255, 255));
  if (channels == 1) {
    cv::mixChannels({narrow}, {rgba}, {0, 0, 0, 1, 0, 2});
  } else if (channels == 3) {
    cv::mixChannels({narrow}, {rgba}, {2, 0, 1, 1, 0, 2});
  } else {
    cv::mixChannels({narrow}, {rgba}, {2, 0, 1, 1, 0, 2, 3, 3});
  }
  return rgba;
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

void CheckImages(const Asset& asset, Faults& faults) {
  for (size_t i = 0; i < asset.images.size(); ++i) {
    const ImageHeader header = ReadImageHeader(asset.images[i]);
    const bool is_foreign =
        header.format == ImageHeader::Format::kOther && !asset.ignored_extensions.empty();
    if (is_foreign) continue;
    if (const auto fault = FaultOf(header)) faults.Add(PointerTo(i), *fault);
  }
}

Picture DecodeImage(const Asset& asset, size_t image, PixelBudget& budget) {
  const ImageHeader header = ReadImageHeader(asset.images[image]);
  if (const auto fault = FaultOf(header)) Refuse(asset, image, *fault);
  if (!budget.Take(size_t{header.width_px} * header.height_px)) {
    Refuse(asset, image,
           fmt::format("with its {} x {} pixels the scene would need more memory than it may have "
                       "(--memory-gb)",
                       header.width_px, header.height_px));
  }
  const cv::Mat decoded = Decode(asset, image);
  const cv::Mat4b rgba = ToRgba(asset, image, decoded);
  Picture picture{.width_px = rgba.cols, .height_px = rgba.rows, .texels = {}};
  picture.texels.reserve(rgba.total());
  for (const cv::Vec4b& texel : rgba)
    picture.texels.emplace_back(texel[0], texel[1], texel[2], texel[3]);
  return picture;
}

}  // namespace fenestra::gltf
