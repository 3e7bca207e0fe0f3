#include "vision/rgbd/plane/frame_paint.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fenestra {
namespace {

constexpr double kGuessedBorder = 0.06;
constexpr int kPlaces = 16;
constexpr double kHidden_m = 0.02;
constexpr double kEndShare = 0.1;  // Share that is left out at each end of a side.

// Returns the pixels along the middle of the border that are in the image.
std::vector<cv::Point> MiddleOf(const CameraView& view, const FrameRectangle& frame, Side side) {
  FrameRectangle middle = frame;
  middle.border_m = 0.5 * (frame.border_m > 0.0 ? frame.border_m : GuessedBorder(frame));
  middle.inner_relief_m = 0.0;
  std::vector<cv::Point> places;
  for (int i = 0; i < kPlaces; ++i) {
    const double share = kEndShare + (1.0 - 2.0 * kEndShare) * (i + 0.5) / kPlaces;
    const auto pixel = view.camera.Project(view.X_CL * middle.PointOn(side, Border::kInner, share));
    if (!pixel || !view.camera.Contains(*pixel)) continue;
    places.emplace_back(static_cast<int>(std::lround(pixel->x())),
                        static_cast<int>(std::lround(pixel->y())));
  }
  return places;
}

}  // namespace

double GuessedBorder(const FrameRectangle& frame) {
  return kGuessedBorder * std::min(frame.width_m, frame.height_m);
}

double BrightestOverDarkestSide(const CameraView& view, const FrameRectangle& frame,
                                double black_dn) {
  double darkest = 255.0;
  double brightest = 0.0;
  for (const Side side : kAllSides) {
    // On a side that the wall's edge hides, the wall is seen instead of the frame.
    if (frame.outer_relief_m[static_cast<size_t>(side)] > kHidden_m) continue;
    std::vector<double> greys;
    for (const cv::Point& place : MiddleOf(view, frame, side)) greys.push_back(view.image(place));
    if (greys.size() < kPlaces / 2) continue;
    const auto middle = greys.begin() + static_cast<std::ptrdiff_t>(greys.size() / 2);
    std::nth_element(greys.begin(), middle, greys.end());
    darkest = std::min(darkest, *middle);
    brightest = std::max(brightest, *middle);
  }
  return std::max(black_dn, brightest) / std::max(black_dn, darkest);
}

double ShareOfColor(const CameraView& view, const FrameRectangle& frame, const WindowPrior& prior,
                    const cv::Mat3b& color) {
  const cv::Mat1b is_expected = ExpectedColor(prior, color);
  int expected = 0;
  for (const Side side : kAllSides) {
    for (const cv::Point& place : MiddleOf(view, frame, side)) {
      if (is_expected(place) != 0) ++expected;
    }
  }
  return expected / (4.0 * kPlaces);
}

}  // namespace fenestra
