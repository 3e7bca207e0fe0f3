#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/io/output_path.h"

namespace fenestra {

/// A named plane of an OpenEXR image, such as "Y", "R" or "depth.Z".
struct ExrChannel {
  std::string name;
  cv::Mat1f values;
};

/// Channels of one size and text attributes.
struct ExrImage {
  std::vector<ExrChannel> channels;  ///< Sorted by name after reading, as in the file.
  std::map<std::string, std::string> metadata;
};

/// Writes 32-bit float channels, ZIP-compressed and so without loss, NaN and infinities included.
/// The file appears by rename. Throws InputError if there are no channels, their sizes differ, a
/// name is empty or used twice, metadata uses a reserved name, or the file cannot be written.
void WriteExr(const OutputPath& file, const std::vector<ExrChannel>& channels,
              const std::map<std::string, std::string>& metadata);

struct ExrReadOptions {
  /// Most values of all channels together; by default 1 GiB in memory, since a small file may claim
  /// to be a huge image.
  int64_t most_values = int64_t{1} << 28;
};

/// Reads the channels (converted to float) and the text attributes of a single-part scan-line or
/// tiled file. Throws InputError if it is missing, damaged, larger than 16384 pixels a side or
/// than the options allow, deep, or has subsampled channels.
ExrImage ReadExr(const std::filesystem::path& file, const ExrReadOptions& options = {});

}  // namespace fenestra
