#include "renderers/sampling/film.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/system/wide.h"

namespace fenestra {
namespace {

void MarkAround(cv::Mat1b& marks, Film::Pixel pixel) {
  const cv::Rect around(pixel.column - 1, pixel.row - 1, 3, 3);
  marks(around & cv::Rect(0, 0, marks.cols, marks.rows)) = uchar{255};
}

// Quarters of the pixels of one row, of `stride` interleaved channels: the plane through the
// neighbours, which is level unless all five pixels are `smooth`. Covers the second pixel to the
// last but one.
struct Rows {
  const float* above;
  const float* here;
  const float* below;
};

FENESTRA_WIDE void Quarter(const Rows& in, const Rows& smooth, int stride, int count,
                           float* upper_left, float* upper_right, float* lower_left,
                           float* lower_right) {
  // A quarter's centre is 1/4 px off; a slope is half the difference of the two neighbours.
  constexpr float kShare = 0.25f * 0.5f;
  for (int i = stride; i < count - stride; ++i) {
    const float flat = kShare * smooth.here[i];
    const float along = flat * smooth.here[i - stride] * smooth.here[i + stride] *
                        (in.here[i + stride] - in.here[i - stride]);
    const float down = flat * smooth.above[i] * smooth.below[i] * (in.below[i] - in.above[i]);
    upper_left[i] = in.here[i] - along - down;
    upper_right[i] = in.here[i] + along - down;
    lower_left[i] = in.here[i] - along + down;
    lower_right[i] = in.here[i] + along + down;
  }
}

// 1 where a pixel is not marked as an edge, in each of its channels.
void SpreadSmooth(const uchar* edges, int channels, std::vector<float>& smooth) {
  float* out = smooth.data();
  for (size_t u = 0; u < smooth.size() / static_cast<size_t>(channels); ++u) {
    const float value = edges[u] == 0 ? 1.0f : 0.0f;
    for (int c = 0; c < channels; ++c) *out++ = value;
  }
}

}  // namespace

Film::Film(int width_px, int height_px, int channels)
    : radiance_(height_px, width_px, CV_MAKETYPE(CV_32F, channels)),
      keys_(height_px, width_px),
      channels_(channels) {}

void Film::Set(Pixel pixel, const QuarteredResult& result) {
  PixelResult whole{.radiance = {}, .key = result.key};
  for (const Radiance& quarter : result.quarters) {
    for (size_t c = 0; c < quarter.size(); ++c) whole.radiance[c] += 0.25f * quarter[c];
  }
  Set(pixel, whole);
  quartered_.emplace_back(pixel, result.quarters);
}

void Film::MarkEdges() {
  const int mixed = static_cast<int>(kMixed);
  edges_ = cv::Mat1b(keys_.size(), uchar{0});
  cv::Mat1b& meets = edges_;
  for (int row = 0; row < keys_.rows; ++row) {
    for (int column = 0; column < keys_.cols; ++column) {
      const int key = keys_(row, column);
      if (key == mixed) {
        MarkAround(meets, {column, row});
        continue;
      }
      // The neighbours before this pixel; those after it will look back.
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
        const int x = column + dx;
        const int y = row + dy;
        if (x < 0 || y < 0 || x >= keys_.cols || keys_(y, x) == key) continue;
        meets(row, column) = 255;
        meets(y, x) = 255;
      }
    }
  }
}

QuarterImages Film::TakeQuarters() const {
  QuarterImages quarters;
  for (cv::Mat& quarter : quarters) quarter.create(radiance_.size(), radiance_.type());
  const int count = radiance_.cols * channels_;
  std::array<std::vector<float>, 3> smooth;  // Of the rows above, here and below.
  for (std::vector<float>& row : smooth) row.resize(static_cast<size_t>(count));
  const auto copy = [&](const cv::Rect& pixels) {
    for (cv::Mat& quarter : quarters) radiance_(pixels).copyTo(quarter(pixels));
  };
  // The outermost pixels are level.
  const cv::Size size = radiance_.size();
  for (const int row : {0, size.height - 1}) copy({0, row, size.width, 1});
  for (const int column : {0, size.width - 1}) copy({column, 0, 1, size.height});
  for (int row = 0; row < size.height; ++row) {
    std::rotate(smooth.begin(), smooth.begin() + 1, smooth.end());
    if (row + 1 < size.height) SpreadSmooth(edges_[row + 1], channels_, smooth[2]);
    if (row == 0) SpreadSmooth(edges_[0], channels_, smooth[1]);
    if (row == 0 || row + 1 == size.height) continue;
    Quarter(
        {radiance_.ptr<float>(row - 1), radiance_.ptr<float>(row), radiance_.ptr<float>(row + 1)},
        {smooth[0].data(), smooth[1].data(), smooth[2].data()}, channels_, count,
        quarters[0].ptr<float>(row), quarters[1].ptr<float>(row), quarters[2].ptr<float>(row),
        quarters[3].ptr<float>(row));
  }
  for (const auto& [pixel, radiance] : quartered_) {
    for (size_t q = 0; q < quarters.size(); ++q) {
      float* out = quarters[q].ptr<float>(pixel.row) + pixel.column * channels_;
      for (int c = 0; c < channels_; ++c) out[c] = radiance[q][static_cast<size_t>(c)];
    }
  }
  return quarters;
}

}  // namespace fenestra
