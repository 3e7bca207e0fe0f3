#include "renderers/film.h"

#include <utility>

namespace fenestra {
namespace {

void MarkAround(cv::Mat1b& marks, Film::Pixel pixel) {
  const cv::Rect around(pixel.column - 1, pixel.row - 1, 3, 3);
  marks(around & cv::Rect(0, 0, marks.cols, marks.rows)) = uchar{255};
}

}  // namespace

Film::Film(int width_px, int height_px, int channels)
    : radiance_(height_px, width_px, CV_MAKETYPE(CV_32F, channels)),
      keys_(height_px, width_px),
      channels_(channels) {}

cv::Mat1b Film::Edges() const {
  const int mixed = static_cast<int>(kMixed);
  cv::Mat1b meets(keys_.size(), uchar{0});
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
  return meets;
}

}  // namespace fenestra
