#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/detection/detector.h"
#include "vision/external/detector_protocol.h"

// A libFuzzer target: any line at all is an answer or a DetectorFailure, an answer is written and
// read again as the same line, and no request is anything but a request or a runtime_error.

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  try {
    fenestra::CheckHelloAnswer(line);
  } catch (const fenestra::DetectorFailure&) {
  }
  try {
    const std::string again = fenestra::DetectAnswer(1, fenestra::ParseDetectAnswer(line, 1));
    if (fenestra::DetectAnswer(1, fenestra::ParseDetectAnswer(again, 1)) != again) abort();
  } catch (const fenestra::DetectorFailure&) {
  }
  try {
    fenestra::ParseRequest(line);
  } catch (const std::runtime_error&) {
  }
  return 0;
}
