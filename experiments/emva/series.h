#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace fenestra::emva {

/// Images of one exposure: in the dark, or in homogeneous light of one wavelength.
struct ImageSet {
  double exposure_s = 0.0;
  double photons = 0.0;  ///< Mean photons per pixel during the exposure; 0: dark.
  /// Files relative to the descriptor's folder. Two images measure temporal noise, more of them the
  /// spatial one.
  std::vector<std::string> files;

  bool is_dark() const { return photons == 0.0; }
  bool is_spatial() const { return files.size() > 2; }
};

/// The images that EMVA 1288 asks for (release 4.0 linear, sections 6 and 8): pairs at many
/// exposures, bright and dark, and one bright and one dark stack at 50 % of saturation.
struct Series {
  int bits = 8;
  cv::Size size;
  std::vector<ImageSet> sets;
};

/// Reads an image of a set by its index [DN].
using ImageReader = std::function<cv::Mat1w(const ImageSet& set, size_t index)>;

/// The descriptor file of the EMVA1288 Python package: a line `n bits width height`, then for each
/// set `b exposure_ns photons` or `d exposure_ns` and its files, `i folder\file`.
std::string ToDescriptor(const Series& series);

/// Reads a descriptor. Throws InputError with all faults and their lines: unknown lines, numbers
/// that are none, sets of fewer than two images, repeated or missing ones.
Series ReadDescriptor(const std::filesystem::path& file);

/// Reads images from the descriptor's folder: PNG or TIFF, 8 or 16 bits, one channel. Throws
/// InputError for a file that is missing or damaged, or of another size or more bits than stated.
ImageReader FilesBeside(const std::filesystem::path& descriptor, const Series& series);

}  // namespace fenestra::emva
