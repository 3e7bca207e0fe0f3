#include "sim/structured_light/infrared_view.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

// Offsets may be up to 64 pixels: they reach every place of an image that is no wider.
constexpr int kFewColumns = 64;
constexpr int kFewRows = 48;
constexpr std::ptrdiff_t kPixelsAtOnce = kFewColumns * kFewRows / PixelParts::kPerPixel;

constexpr double kJump_px = 0.25;

CameraModel WithFewPixels(const CameraModel& camera) {
  CameraParameters k = camera.parameters();
  const double s = static_cast<double>(kFewColumns) / k.width_px;
  const double t = static_cast<double>(kFewRows) / k.height_px;
  k.width_px = kFewColumns;
  k.height_px = kFewRows;
  k.fx_px *= s;
  k.fy_px *= t;
  k.cx_px = (k.cx_px + 0.5) * s - 0.5;
  k.cy_px = (k.cy_px + 0.5) * t - 0.5;
  return CameraModel(k);
}

}  // namespace

CameraModel InfraredImageLayout::CameraOf(const CameraModel& depth) const {
  CameraParameters k = depth.parameters();
  k.width_px = scale * k.width_px;
  k.height_px = scale * k.height_px + 2 * reach.height;
  k.fx_px *= scale;
  k.fy_px *= scale;
  k.cx_px = scale * k.cx_px + reach.width;
  k.cy_px = scale * k.cy_px + reach.height;
  return CameraModel(k);
}

RollingShutter InfraredImageLayout::ShutterOf(const CameraModel& depth,
                                              const RollingShutter& shutter) const {
  const double rows = scale * depth.height_px();
  return {.motion = shutter.motion,
          .readout_s = shutter.readout_s * (rows + 2 * reach.height) / rows};
}

Eigen::Vector2d PixelParts::OffsetOf(int part) {
  // The points of Hammersley's net: v is u's binary fraction in reverse.
  const int reversed = ((part & 1) << 2) | (part & 2) | ((part & 4) >> 2);
  return {(part + 0.5) / kPerPixel - 0.5, (reversed + 0.5) / kPerPixel - 0.5};
}

InfraredRays::InfraredRays(const CameraModel& camera, const RollingShutter& shutter)
    : rays_(camera, shutter), few_rays_(WithFewPixels(camera)) {}

Eigen::Vector3d InfraredRays::RayAt(double u_px, double v_px) const {
  const CameraParameters& k = camera().parameters();
  return {(u_px - k.cx_px) / k.fx_px, (v_px - k.cy_px) / k.fy_px, 1.0};
}

InfraredView InfraredRays::Cast(const RayCaster& caster, const Pose& X_WC, const Lighting& lighting,
                                const Eigen::Vector3d& p_CP) const {
  InfraredView view{.aovs = rays_.CastAovs(caster, X_WC, lighting, p_CP), .parts = {}};
  const std::vector<cv::Point> crossed =
      CrossedPixels(view.aovs, camera().parameters().fx_px * p_CP.norm());
  auto next = crossed.begin();
  for (const RowBand& band : rays_.row_bands()) {
    const auto end = std::find_if(next, crossed.end(), [&](const cv::Point& pixel) {
      return pixel.y >= band.first + band.count;
    });
    const Pose X_WCv = rays_.PoseIn(band, X_WC);
    while (next != end) {
      const auto count = std::min<std::ptrdiff_t>(kPixelsAtOnce, end - next);
      view.parts.push_back(CastParts(caster, X_WCv, lighting, X_WCv * p_CP, {next, next + count}));
      next += count;
    }
  }
  return view;
}

PixelParts InfraredRays::CastParts(const RayCaster& caster, const Pose& X_WC,
                                   const Lighting& lighting, const Eigen::Vector3d& p_WP,
                                   std::vector<cv::Point> pixels) const {
  const double s = static_cast<double>(kFewColumns) / camera().width_px();
  const double t = static_cast<double>(kFewRows) / camera().height_px();
  PixelParts parts{.pixels = std::move(pixels), .aovs = {}};
  AovOptions options{.offsets_px = cv::Mat2f(kFewRows, kFewColumns, cv::Vec2f(0.0f, 0.0f)),
                     .p_WP = p_WP};
  for (size_t i = 0; i < parts.pixels.size(); ++i) {
    for (int part = 0; part < PixelParts::kPerPixel; ++part) {
      const int ray = static_cast<int>(i) * PixelParts::kPerPixel + part;
      const cv::Point place(ray % kFewColumns, ray / kFewColumns);
      const Eigen::Vector2d offset = PixelParts::OffsetOf(part);
      const double u = (parts.pixels[i].x + offset.x() + 0.5) * s - 0.5;
      const double v = (parts.pixels[i].y + offset.y() + 0.5) * t - 0.5;
      options.offsets_px(place) =
          cv::Vec2f(static_cast<float>(u - place.x), static_cast<float>(v - place.y));
    }
  }
  parts.aovs = caster.CastAovs(few_rays_, X_WC, lighting, options);
  return parts;
}

std::vector<cv::Point> CrossedPixels(const AovImages& aovs, double fb) {
  const cv::Size size = aovs.depth_m.size();
  const auto jump = static_cast<float>(kJump_px / fb);
  const auto differ = [&](cv::Point a, cv::Point b) {
    // Without a surface the depth is NaN, but then the objects differ, too, or both are none.
    return aovs.object_id(a) != aovs.object_id(b) || aovs.sees_point(a) != aovs.sees_point(b) ||
           aovs.sees_sun(a) != aovs.sees_sun(b) ||
           std::abs(1.0f / aovs.depth_m(a) - 1.0f / aovs.depth_m(b)) > jump;
  };
  cv::Mat1b crossed = cv::Mat1b::zeros(size);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const cv::Point here(u, v);
      for (const cv::Point next : {cv::Point(u + 1, v), cv::Point(u, v + 1)}) {
        if (next.x < size.width && next.y < size.height && differ(here, next)) {
          crossed(here) = crossed(next) = 255;
        }
      }
    }
  }
  std::vector<cv::Point> pixels;
  cv::findNonZero(crossed, pixels);
  return pixels;
}

}  // namespace fenestra
