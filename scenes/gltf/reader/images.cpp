#include "scenes/gltf/reader/images.h"

#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "scenes/gltf/file/image_header.h"

namespace fenestra::gltf {
namespace {

constexpr uint32_t kLargestSide = 16384;

// nullopt: fine.
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

// 8 bits, in the order red, green, blue, alpha.
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
           fmt::format("{} x {} more pixels are more than is read for one scene", header.width_px,
                       header.height_px));
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
