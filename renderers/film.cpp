#include "renderers/film.h"

#include <utility>

#include "core/wide.h"

namespace fenestra {
namespace {

void MarkAround(cv::Mat1b& marks, Film::Pixel pixel) {
  const cv::Rect around(pixel.column - 1, pixel.row - 1, 3, 3);
  marks(around & cv::Rect(0, 0, marks.cols, marks.rows)) = uchar{255};
}

// Quarters of the pixels of one row, of `stride` interleaved channels: the plane through the
// neighbours, as steep as `smooth` of all five pixels lets it be. From the second pixel to the last
// but one.
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
  for (cv::Mat& quarter : quarters) quarter = radiance_.clone();
  cv::Mat smooth;
  edges_.convertTo(smooth, CV_32F, -1.0 / 255.0, 1.0);
  if (channels_ > 1) {
    cv::merge(std::vector<cv::Mat>(static_cast<size_t>(channels_), smooth), smooth);
  }
  const auto rows = [](const cv::Mat& image, int row) {
    return Rows{image.ptr<float>(row - 1), image.ptr<float>(row), image.ptr<float>(row + 1)};
  };
  for (int row = 1; row < radiance_.rows - 1; ++row) {
    Quarter(rows(radiance_, row), rows(smooth, row), channels_, radiance_.cols * channels_,
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
