#include "vision/frame/measurement/frame_border.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

constexpr int kPlaces = 16;
constexpr double kBorderEndShare = 0.1;
// Distance from the outer edge, so that its blur is not taken for the end of the border.
constexpr double kClear_px = 2.0;

// Size of a pixel on the frame where it is seen most obliquely; the mean over the views.
double PixelOn(std::span<const CameraView> views, const FrameRectangle& frame) {
  double sum_m = 0.0;
  for (const CameraView& view : views) {
    const Eigen::Vector3d p_CO = view.X_CL * frame.p_LO;
    const Eigen::Vector3d normal_C = view.X_CL.rotation() * frame.R_LO.col(2);
    const double distance_m = p_CO.norm();
    const double cosine = std::max(0.3, std::abs(normal_C.dot(p_CO)) / distance_m);
    sum_m += distance_m / (view.camera.parameters().fx_px * cosine);
  }
  return sum_m / static_cast<double>(views.size());
}

// Mean over the views that see it.
std::optional<double> MeanOfViews(std::span<const CameraView> views, const FrameRectangle& frame,
                                  Side side) {
  double sum = 0.0;
  int count = 0;
  for (const CameraView& view : views) {
    const auto mean = MeanAlong(view, frame, side);
    if (!mean) continue;
    sum += *mean;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

double BandIn(const CameraView& view, const FrameRectangle& frame, double black_dn) {
  double most = 0.0;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    FrameRectangle outset = frame;
    const auto brightness = [&](double distance_m) {
      outset.border_m = -distance_m;
      const auto grey = MeanAlong(view, outset, side);
      return grey ? std::max(1.0, *grey - black_dn) : 0.0;
    };
    const double near = std::max({brightness(0.03), brightness(0.05), brightness(0.07)});
    const double far = brightness(0.25);
    if (near <= 0.0 || far <= 0.0) continue;
    most = std::max(most, std::log(near / far / 1.4) / std::log(2.0 / 1.4));
  }
  return std::min(1.0, most);
}

}  // namespace

std::optional<double> MeanAlong(const CameraView& view, const FrameRectangle& frame, Side side) {
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double share = kBorderEndShare + (1.0 - 2.0 * kBorderEndShare) * (i + 0.5) / kPlaces;
    const auto pixel = view.camera.Project(view.X_CL * frame.PointOn(side, Border::kInner, share));
    if (!pixel) continue;
    const int u = static_cast<int>(std::lround(pixel->x()));
    const int v = static_cast<int>(std::lround(pixel->y()));
    if (u < 0 || v < 0 || u >= view.image.cols || v >= view.image.rows) continue;
    sum += view.image(v, u);
    ++count;
  }
  if (2 * count < kPlaces) return std::nullopt;
  return sum / count;
}

std::optional<BorderFound> FindBorder(std::span<const CameraView> views,
                                      const FrameRectangle& frame, const BorderSearch& search) {
  const double pixel_m = PixelOn(views, frame);
  const double step_m = 0.5 * pixel_m;
  const double first_m = std::max(search.smallest_m, kClear_px * pixel_m);
  const double last_m = search.largest_share * std::min(frame.width_m, frame.height_m);
  const int count = static_cast<int>((last_m - first_m) / step_m);
  if (count < 6) return std::nullopt;
  FrameRectangle inset = frame;
  std::array<std::vector<std::optional<double>>, 4> profiles;
  for (int i = 0; i < count; ++i) {
    inset.border_m = first_m + i * step_m;
    for (const Side side : kAllSides) {
      profiles[static_cast<size_t>(side)].push_back(MeanOfViews(views, inset, side));
    }
  }
  std::optional<BorderFound> best;
  const int half = 2;  // A pixel on either side.
  for (int i = half; i + half < count; ++i) {
    BorderFound found{.border_m = first_m + i * step_m, .brighter = {}, .contrast_dn = 0.0};
    for (size_t side = 0; side < 4; ++side) {
      const auto& outer = profiles[side][i - half];
      const auto& inner = profiles[side][i + half];
      if (!outer || !inner) continue;
      found.brighter[side] = *inner > *outer ? Brighter::kInside : Brighter::kOutside;
      found.contrast_dn += 0.25 * std::abs(*inner - *outer);
    }
    if (!best || found.contrast_dn > best->contrast_dn) best = found;
  }
  if (!best || best->contrast_dn < search.min_contrast_dn) return std::nullopt;
  return best;
}

double BrightBand(std::span<const CameraView> views, const FrameRectangle& frame, double black_dn) {
  double sum = 0.0;
  for (const CameraView& view : views) sum += BandIn(view, frame, black_dn);
  return sum / static_cast<double>(views.size());
}

}  // namespace fenestra
