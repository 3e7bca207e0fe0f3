#include <opencv2/core/utils/logger.hpp>

#include "core/io/image_io.h"
#include "core/io/input_error.h"
#include "tests/fuzz/input_file.h"

// A libFuzzer target: any bytes at all are an image of the kind asked for or an InputError.

namespace {

template <typename Read>
void Try(const Read& read, const std::filesystem::path& file) {
  try {
    read(file);
  } catch (const fenestra::InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  const std::filesystem::path file = fenestra::InputFile(data, size, ".png");
  Try(fenestra::ReadGrayImage, file);
  Try(fenestra::ReadColorImage, file);
  Try(fenestra::ReadDepthImage, file);
  return 0;
}
