#include "core/io/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fenestra {
namespace {

// thresholds[i]: the smallest linear value that is encoded as i + 1.
std::array<float, 255> MakeThresholds() {
  std::array<float, 255> thresholds{};
  for (size_t i = 0; i < thresholds.size(); ++i) {
    thresholds[i] = static_cast<float>(LinearFromSrgb((static_cast<double>(i) + 0.5) / 255.0));
  }
  return thresholds;
}

// The smallest code of a linear value, by its upper 12 bits.
std::array<unsigned char, 4097> MakeFirstCodes(const std::array<float, 255>& thresholds) {
  std::array<unsigned char, 4097> codes{};
  for (size_t i = 0; i < codes.size(); ++i) {
    const float linear = static_cast<float>(i) / 4096.0f;
    codes[i] = static_cast<unsigned char>(
        std::upper_bound(thresholds.begin(), thresholds.end(), linear) - thresholds.begin());
  }
  return codes;
}

}  // namespace

double LinearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double SrgbFromLinear(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

double SrgbSlope(double linear) {
  return linear <= 0.0031308 ? 12.92 : 1.055 / 2.4 * std::pow(linear, 1.0 / 2.4 - 1.0);
}

cv::Mat1b EncodeSrgb(const cv::Mat1f& linear) {
  static const std::array<float, 255> thresholds = MakeThresholds();
  static const std::array<unsigned char, 4097> first_codes = MakeFirstCodes(thresholds);
  cv::Mat1b encoded(linear.size());
  for (int v = 0; v < linear.rows; ++v) {
    for (int u = 0; u < linear.cols; ++u) {
      const float x = std::clamp(linear(v, u), 0.0f, 1.0f);
      unsigned code = first_codes[static_cast<size_t>(x * 4096.0f)];
      while (code < 255 && x >= thresholds[code]) ++code;
      encoded(v, u) = static_cast<unsigned char>(code);
    }
  }
  return encoded;
}

}  // namespace fenestra
