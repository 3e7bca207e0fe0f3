#include "vision/frame/measurement/side_sampling.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr double kLength_px = 8.0;
constexpr int kFewest = 3;
constexpr int kMost = 40;
constexpr int kFewestCoarse = 30;

// Axis-aligned box around a strip that reaches from `inside_px` on one side of the edge to
// `outside_px` on the other.
cv::Rect BoxOf(const EdgeStrip& strip, double half_length_px, double inside_px, double outside_px) {
  const Vector2d middle = strip.pixel + 0.5 * (outside_px - inside_px) * strip.normal;
  const Vector2d along(-strip.normal.y(), strip.normal.x());
  const Vector2d extent =
      0.5 * (outside_px + inside_px) * strip.normal.cwiseAbs() + half_length_px * along.cwiseAbs();
  const cv::Point first(static_cast<int>(std::ceil(middle.x() - extent.x())),
                        static_cast<int>(std::ceil(middle.y() - extent.y())));
  const cv::Point end(static_cast<int>(std::floor(middle.x() + extent.x())) + 1,
                      static_cast<int>(std::floor(middle.y() + extent.y())) + 1);
  return {first, end};
}

// Returns no pixels if one of those near the edge is outside the image.
std::vector<StripPixel> Gather(const cv::Mat1b& image, const EdgeStrip& strip,
                               double half_length_px, const SideRequest& request) {
  std::vector<StripPixel> pixels;
  const cv::Rect whole({0, 0}, image.size());
  const cv::Rect near = BoxOf(strip, half_length_px, request.reach_px, request.reach_px);
  if ((near & whole) != near) return pixels;
  const cv::Rect box =
      BoxOf(strip, half_length_px, request.inside_px(), request.outside_px()) & whole;
  const Vector2d along(-strip.normal.y(), strip.normal.x());
  pixels.reserve(static_cast<size_t>(box.area()));
  for (int v = box.y; v < box.br().y; ++v) {
    const uchar* row = image.ptr(v);
    for (int u = box.x; u < box.br().x; ++u) {
      const Vector2d offset = Vector2d(u, v) - strip.pixel;
      const double s = offset.dot(strip.normal);
      if (s > request.outside_px() || s < -request.inside_px()) continue;
      if (std::abs(offset.dot(along)) > half_length_px) continue;
      pixels.push_back({s, static_cast<double>(row[u])});
    }
  }
  return pixels;
}

bool IsCut(int i, int count, const SideRequest& request) {
  if (!request.coarse || count < kFewestCoarse) return true;
  const int from_middle = std::abs(2 * i - (count - 1));  // In half strips.
  return from_middle % 6 == (count % 2 == 1 ? 0 : 3);
}

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

EdgeStrips CutStrips(const CameraView& view, const FrameRectangle& frame,
                     const SideRequest& request) {
  const auto pixel_at = [&](double share) {
    return view.camera.Project(view.X_CL * frame.PointOn(request.side, request.border, share));
  };
  EdgeStrips cut;
  const auto first = pixel_at(0.0);
  const auto last = pixel_at(1.0);
  if (!first || !last) return cut;
  const double length_px = (*last - *first).norm();
  const double margin = (request.reach_px + 1.0) / std::max(1.0, length_px);
  const double usable = 1.0 - 2.0 * margin;
  if (usable * length_px < kFewest * 2.0) return cut;
  const int count = std::clamp(static_cast<int>(usable * length_px / kLength_px), kFewest, kMost);
  const double step = usable / count;
  for (int i = 0; i < count; ++i) {
    if (!IsCut(i, count, request)) continue;
    const double share = margin + (i + 0.5) * step;
    const auto from = pixel_at(share - 0.5 * step);
    const auto to = pixel_at(share + 0.5 * step);
    const auto middle = pixel_at(share);
    if (!from || !to || !middle) continue;
    ++cut.places;
    const Vector2d along = (*to - *from).normalized();
    EdgeStrip strip{
        .share = share, .pixel = *middle, .normal = {along.y(), -along.x()}, .pixels = {}};
    strip.pixels = Gather(view.image, strip, 0.5 * (*to - *from).norm(), request);
    if (strip.pixels.size() >= 8) cut.strips.push_back(std::move(strip));
  }
  return cut;
}

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
