#include "vision/rgbd/plane/linear_grey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/io/srgb.h"

namespace fenestra {
namespace {

constexpr double kBright_dn = 200.0;
constexpr double kBrightShare = 0.98;
constexpr int kUnits = 5461;  // Largest value of a channel; the sum of three fills 14 bits.
constexpr int kSums = 3 * kUnits + 1;

std::array<int, 256> MakeTable() {
  std::array<int, 256> table{};
  for (size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<int>(std::lround(kUnits * LinearFromSrgb(static_cast<double>(i) / 255)));
  }
  return table;
}

}  // namespace

cv::Mat1b LinearGrey(const cv::Mat3b& color) {
  static const std::array<int, 256> linear = MakeTable();
  if (color.empty()) return {};
  cv::Mat1w sums(color.size());
  std::vector<int> counts(kSums, 0);
  for (int v = 0; v < color.rows; ++v) {
    const cv::Vec3b* row = color.ptr<cv::Vec3b>(v);
    ushort* out = sums.ptr<ushort>(v);
    for (int u = 0; u < color.cols; ++u) {
      const int sum = linear[row[u][0]] + linear[row[u][1]] + linear[row[u][2]];
      out[u] = static_cast<ushort>(sum);
      ++counts[static_cast<size_t>(sum)];
    }
  }
  const double wanted = kBrightShare * static_cast<double>(color.total());
  int bright = 0;
  for (double below = counts[0]; below < wanted && bright + 1 < kSums;) {
    below += counts[static_cast<size_t>(++bright)];
  }
  const double unclipped = kBright_dn / std::max(1, bright);
  cv::Mat1b grey;
  sums.convertTo(grey, CV_8U, std::max(255.0 / (kSums - 1), unclipped));
  return grey;
}

}  // namespace fenestra
