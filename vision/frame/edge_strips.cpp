#include "vision/frame/edge_strips.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr double kLength_px = 8.0;
constexpr int kFewest = 3;
constexpr int kMost = 40;

// Empty if one of them is outside the image.
std::vector<StripPixel> Gather(const cv::Mat1b& image, const EdgeStrip& strip,
                               double half_length_px, double reach_px) {
  const Vector2d along(-strip.normal.y(), strip.normal.x());
  const Vector2d extent = reach_px * strip.normal.cwiseAbs() + half_length_px * along.cwiseAbs();
  const int u_first = static_cast<int>(std::ceil(strip.pixel.x() - extent.x()));
  const int u_last = static_cast<int>(std::floor(strip.pixel.x() + extent.x()));
  const int v_first = static_cast<int>(std::ceil(strip.pixel.y() - extent.y()));
  const int v_last = static_cast<int>(std::floor(strip.pixel.y() + extent.y()));
  std::vector<StripPixel> pixels;
  if (u_first < 0 || v_first < 0 || u_last >= image.cols || v_last >= image.rows) return pixels;
  pixels.reserve(static_cast<size_t>(u_last - u_first + 1) * (v_last - v_first + 1));
  for (int v = v_first; v <= v_last; ++v) {
    const uchar* row = image.ptr(v);
    for (int u = u_first; u <= u_last; ++u) {
      const Vector2d offset = Vector2d(u, v) - strip.pixel;
      const double s = offset.dot(strip.normal);
      if (std::abs(s) > reach_px || std::abs(offset.dot(along)) > half_length_px) continue;
      pixels.push_back({s, static_cast<double>(row[u])});
    }
  }
  return pixels;
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
    const double share = margin + (i + 0.5) * step;
    const auto from = pixel_at(share - 0.5 * step);
    const auto to = pixel_at(share + 0.5 * step);
    const auto middle = pixel_at(share);
    if (!from || !to || !middle) continue;
    ++cut.places;
    const Vector2d along = (*to - *from).normalized();
    EdgeStrip strip{
        .share = share, .pixel = *middle, .normal = {along.y(), -along.x()}, .pixels = {}};
    strip.pixels = Gather(view.image, strip, 0.5 * (*to - *from).norm(), request.reach_px);
    if (strip.pixels.size() >= 8) cut.strips.push_back(std::move(strip));
  }
  return cut;
}

}  // namespace fenestra
