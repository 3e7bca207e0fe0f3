#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace fenestra::emva {

/// Frames of one exposure: in the dark, or in homogeneous light of one wavelength.
struct FrameSet {
  double exposure_s = 0.0;
  double photons = 0.0;  ///< Mean photons per pixel during the exposure; 0: dark.
  /// Files relative to the descriptor's folder. Two frames measure temporal noise, more of them the
  /// spatial one.
  std::vector<std::string> frames;

  bool is_dark() const { return photons == 0.0; }
  bool is_spatial() const { return frames.size() > 2; }
};

/// The frames that EMVA 1288 asks for (release 4.0 linear, sections 6 and 8): pairs at many
/// exposures, bright and dark, and one bright and one dark stack at 50 % of saturation.
struct Series {
  int bits = 8;
  cv::Size size;
  std::vector<FrameSet> sets;
};

/// The frame of a set [DN].
using FrameReader = std::function<cv::Mat1w(const FrameSet& set, size_t frame)>;

/// The descriptor file of the EMVA1288 Python package: a line `n bits width height`, then for each
/// set `b exposure_ns photons` or `d exposure_ns` and its files, `i folder\file`.
std::string ToDescriptor(const Series& series);

/// Reads a descriptor. Throws InputError with all faults and their lines: unknown lines, numbers
/// that are none, sets of fewer than two frames, repeated or missing ones.
Series ReadDescriptor(const std::filesystem::path& file);

/// Reads frames from the descriptor's folder: PNG or TIFF, 8 or 16 bits, one channel. Throws
/// InputError for a file that is missing or damaged, or of another size or more bits than stated.
FrameReader FilesBeside(const std::filesystem::path& descriptor, const Series& series);

}  // namespace fenestra::emva
