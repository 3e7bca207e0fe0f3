#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "core/io/output_path.h"

namespace fenestra {

/// Image files as sensors and recorders write them. All readers throw InputError for a file that
/// is missing, damaged, larger than 16384 pixels a side, or of another kind than the one asked for.

/// 8-bit grey image; a colour file is refused, since its conversion is a choice of the caller.
cv::Mat1b ReadGrayImage(const std::filesystem::path& file);

/// 8-bit colour image, channels B, G, R. A grey file is repeated in all channels; alpha is dropped.
cv::Mat3b ReadColorImage(const std::filesystem::path& file);

/// 16-bit single-channel image; 0: no return. The largest value, 65535, becomes 0: it is where the
/// numbers end, and what some drivers write for no return.
cv::Mat1w ReadDepthImage(const std::filesystem::path& file);

/// Writes a PNG file that appears by rename. Throws InputError if it cannot be written.
void WritePng(const OutputPath& file, const cv::Mat& image);

}  // namespace fenestra
