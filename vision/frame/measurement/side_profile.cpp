#include "vision/frame/measurement/side_profile.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

constexpr double kEndShare = 0.15;
// A lens bends a line by less than a pixel; between these nodes it is straight to hundredths of a
// pixel.
constexpr int kPieces = 4;
constexpr int kPlacesPerPiece = 16;
constexpr double kRounding = 1.0 / 12.0;  // Variance of a rounded grey value.
constexpr double kUnseen = 1e9;

double Bilinear(const cv::Mat1b& image, const Eigen::Vector2d& pixel) {
  const int u = static_cast<int>(std::floor(pixel.x()));
  const int v = static_cast<int>(std::floor(pixel.y()));
  const double a = pixel.x() - u;
  const double b = pixel.y() - v;
  return (1.0 - b) * ((1.0 - a) * image(v, u) + a * image(v, u + 1)) +
         b * ((1.0 - a) * image(v + 1, u) + a * image(v + 1, u + 1));
}

// Returns the pixels along the middle of a side moved inwards, or none if not all of them are seen.
std::vector<Eigen::Vector2d> LineAt(const CameraView& view, FrameRectangle frame, Side side,
                                    double inset_m) {
  frame.border_m = inset_m;
  frame.inner_relief_m = 0.0;
  std::vector<Eigen::Vector2d> line;
  for (int i = 0; i <= kPieces; ++i) {
    const double share = kEndShare + (1.0 - 2.0 * kEndShare) * i / kPieces;
    const auto pixel = view.camera.Project(view.X_CL * frame.PointOn(side, Border::kInner, share));
    if (!pixel) return {};
    line.push_back(*pixel);
  }
  return line;
}

}  // namespace

SideProfile ProfileAcross(const CameraView& view, const FrameRectangle& frame, Side side,
                          const ProfileGrid& grid) {
  SideProfile profile;
  const Eigen::Vector2d last(view.image.cols - 1, view.image.rows - 1);
  for (int i = 0; i < grid.count; ++i) {
    const std::vector<Eigen::Vector2d> line = LineAt(view, frame, side, grid.InsetAt(i));
    double sum = 0.0;
    double squares = 0.0;
    int places = 0;
    for (size_t piece = 1; piece < line.size(); ++piece) {
      for (int j = 0; j < kPlacesPerPiece; ++j) {
        const double share = (j + 0.5) / kPlacesPerPiece;
        const Eigen::Vector2d pixel = line[piece - 1] + share * (line[piece] - line[piece - 1]);
        if (pixel.minCoeff() < 0.0 || (last - pixel).minCoeff() <= 0.0) continue;
        const double grey_dn = Bilinear(view.image, pixel);
        sum += grey_dn;
        squares += grey_dn * grey_dn;
        ++places;
      }
    }
    const bool seen = 4 * places > 3 * kPieces * kPlacesPerPiece;
    const double mean = seen ? sum / places : 0.0;
    profile.grey_dn.push_back(mean);
    if (!seen) {
      profile.variance.push_back(kUnseen);
      continue;
    }
    const double length_px = (line.back() - line.front()).norm();
    const double independent = std::clamp(length_px, 1.0, static_cast<double>(places));
    profile.variance.push_back((squares / places - mean * mean + kRounding) / independent);
  }
  return profile;
}

double PixelAcross(const CameraView& view, const FrameRectangle& frame, Side side) {
  constexpr double kLength_m = 0.02;
  FrameRectangle inset = frame;
  inset.border_m = kLength_m;
  inset.inner_relief_m = 0.0;
  const auto at_side = view.camera.Project(view.X_CL * frame.PointOn(side, Border::kOuter, 0.5));
  const auto within = view.camera.Project(view.X_CL * inset.PointOn(side, Border::kInner, 0.5));
  if (!at_side || !within) return 0.0;
  return kLength_m / std::max(1e-3, (*at_side - *within).norm());
}

}  // namespace fenestra
