#include <cstdlib>

#include "core/geometry/calibration.h"
#include "core/io/input_error.h"
#include "tests/fuzz/input_file.h"

// A libFuzzer target: any bytes at all are a calibration or an InputError, and a calibration that
// was read is read again as the same one.

namespace {

template <typename Read>
void Try(const Read& read, const std::filesystem::path& file) {
  try {
    const auto calibration = read(file);
    if constexpr (requires { fenestra::ToOpenCvYaml(calibration); }) {
      const std::string text = fenestra::ToOpenCvYaml(calibration);
      const auto* bytes = reinterpret_cast<const uint8_t*>(text.data());
      if (!(read(fenestra::InputFile(bytes, text.size(), ".again.yaml")) == calibration)) abort();
    }
  } catch (const fenestra::InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::filesystem::path file = fenestra::InputFile(data, size, ".yaml");
  Try(fenestra::ReadStereoCalibration, file);
  Try(fenestra::ReadRgbdCalibration, file);
  Try(fenestra::ReadCameraInfo, file);
  return 0;
}
