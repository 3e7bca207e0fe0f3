#include "renderers/aov_cast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/input_error.h"
#include "renderers/tracing/pane_kernels.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

constexpr float kLargestOffset_px = 64.0f;

void Check(const AovOptions& options, const cv::Size& size) {
  if (options.p_WP && !options.p_WP->allFinite()) throw InputError("aovs", "p_WP is not finite");
  const cv::Mat2f& offsets = options.offsets_px;
  if (offsets.empty()) return;
  if (offsets.size() != size) {
    throw InputError("aovs", fmt::format("offsets for {} x {} px do not fit an image of {} x {} px",
                                         offsets.cols, offsets.rows, size.width, size.height));
  }
  for (const cv::Vec2f& offset : offsets) {
    // Written so that NaN fails.
    if (!(std::abs(offset[0]) <= kLargestOffset_px && std::abs(offset[1]) <= kLargestOffset_px)) {
      throw InputError("aovs", fmt::format("the offset ({}, {}) px is not within {} px", offset[0],
                                           offset[1], kLargestOffset_px));
    }
  }
}

AovImages MakeImages(const cv::Size& size, bool with_point) {
  AovImages images;
  images.depth_m = cv::Mat1f(size, std::numeric_limits<float>::quiet_NaN());
  images.normal_C = cv::Mat3f(size, cv::Vec3f(0.0f, 0.0f, 0.0f));
  images.object_id = cv::Mat1i(size, -1);
  images.material_id = cv::Mat1i(size, -1);
  images.sees_sun = cv::Mat1b(size, uchar{0});
  if (with_point) images.sees_point = cv::Mat1b(size, uchar{0});
  images.transmittance = cv::Mat1f(size, 1.0f);
  images.reflectance_830nm = cv::Mat1f(size, 0.0f);
  images.irradiance_lx = cv::Mat1f(size, 0.0f);
  images.irradiance_830 = cv::Mat1f(size, 0.0f);
  return images;
}

// Normalised image coordinates at a pixel; outside the image the border's spacing continues.
Eigen::Vector2f ImagePointAt(const RayGrid& rays, float u_px, float v_px) {
  const float x = u_px + 0.5f;
  const float y = v_px + 0.5f;
  const int column = std::clamp(static_cast<int>(std::floor(x)), 0, rays.width_px() - 1);
  const int row = std::clamp(static_cast<int>(std::floor(y)), 0, rays.height_px() - 1);
  const float s = x - static_cast<float>(column);
  const float t = y - static_cast<float>(row);
  const Eigen::Vector2f top =
      (1.0f - s) * rays.Corner(column, row) + s * rays.Corner(column + 1, row);
  const Eigen::Vector2f bottom =
      (1.0f - s) * rays.Corner(column, row + 1) + s * rays.Corner(column + 1, row + 1);
  return (1.0f - t) * top + t * bottom;
}

class AovCaster {
 public:
  AovCaster(const Scene& scene, const TracedScene& traced, const LightTransport& light,
            const RayGrid& rays, const Pose& X_WC, const AovOptions& options)
      : scene_(scene),
        traced_(traced),
        light_(light),
        rays_(rays),
        X_WC_(X_WC),
        camera_(ToFloat(X_WC)),
        options_(options),
        images_(MakeImages({rays.width_px(), rays.height_px()}, options.p_WP.has_value())) {}

  AovImages Cast() && {
    for (int row = 0; row < rays_.height_px(); ++row) {
      for (int column = 0; column < rays_.width_px(); column += kLanes) {
        CastPacket(row, column, std::min(kLanes, rays_.width_px() - column));
      }
    }
    return std::move(images_);
  }

 private:
  void CastPacket(int row, int first_column, int count) {
    const LaneMask mask = FirstLanes(count);
    RayPacket packet;
    SetRays(packet, camera_.p_WC, DirectionsAt(row, first_column, count));
    const LightTransport::Ends ends = light_.TraceOpaque(mask, packet);
    for (int i = 0; i < count; ++i) {
      const int column = first_column + i;
      images_.transmittance(row, column) = ends.transmittance[i];
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      Describe(packet, i, row, column);
      images_.sees_sun(row, column) = ends.sun[i] > 0.0f ? 255 : 0;
      images_.irradiance_lx(row, column) = ends.radiance[0][i];
      images_.irradiance_830(row, column) = ends.radiance[1][i];
    }
    if (options_.p_WP) LookAtPoint(packet, row, first_column, count);
  }

  Directions DirectionsAt(int row, int first_column, int count) const {
    ImagePoints points;
    for (int i = 0; i < count; ++i) {
      const int column = first_column + i;
      cv::Vec2f offset(0.0f, 0.0f);
      if (!options_.offsets_px.empty()) offset = options_.offsets_px(row, column);
      const Eigen::Vector2f point = ImagePointAt(rays_, static_cast<float>(column) + offset[0],
                                                 static_cast<float>(row) + offset[1]);
      points.x[i] = point.x();
      points.y[i] = point.y();
    }
    return ToWorld(camera_.axes, points.x, points.y);
  }

  // Depth is found anew from the triangle's plane, since the ray tracer's is good for finding the
  // nearest surface but has an error of some 1e-6.
  void Describe(const RayPacket& packet, int lane, int row, int column) {
    const TriangleSoup& soup = traced_.opaque();
    const uint32_t triangle = packet.hit.primID[lane];
    const glm::vec3& n = soup.normals_W[triangle];
    const glm::vec3& a = soup.positions_W[soup.triangles[triangle].x];
    const Vector3d n_W = Vector3d(n.x, n.y, n.z);
    const Vector3d p_WA = Vector3d(a.x, a.y, a.z);
    const Vector3d d_W =
        Vector3d(packet.ray.dir_x[lane], packet.ray.dir_y[lane], packet.ray.dir_z[lane]);
    const double approach = n_W.dot(d_W);
    const double depth_m = n_W.dot(p_WA - X_WC_.translation()) / approach;
    const Vector3d normal_C =
        X_WC_.rotation().transpose() * (approach < 0.0 ? n_W : Vector3d(-n_W));
    images_.depth_m(row, column) = static_cast<float>(depth_m);
    images_.normal_C(row, column) =
        cv::Vec3f(static_cast<float>(normal_C.x()), static_cast<float>(normal_C.y()),
                  static_cast<float>(normal_C.z()));
    const uint32_t mesh = soup.mesh_of[triangle];
    images_.object_id(row, column) = static_cast<int>(mesh);
    const uint32_t material = scene_.meshes[mesh].material;
    images_.material_id(row, column) = static_cast<int>(material);
    images_.reflectance_830nm(row, column) =
        scene_.materials[material].reflectance_830nm * PatternAt830(packet, lane);
  }

  // The factor of the surface's pattern at 830 nm, at exactly this point.
  float PatternAt830(const RayPacket& packet, int lane) const {
    const SurfacePatterns& patterns = traced_.patterns();
    const uint32_t triangle = packet.hit.primID[lane];
    if (!patterns.has_pattern(triangle)) return 1.0f;
    return PatternSpectrum(patterns.At(triangle, packet.hit.u[lane], packet.hit.v[lane], 0.0f)).w;
  }

  void LookAtPoint(const RayPacket& packet, int row, int first_column, int count) {
    const Eigen::Vector3f p_WP = options_.p_WP->cast<float>();
    RTCRay16 to_point = RaysFromHits(packet, traced_.SurfaceOffset({p_WP.x(), p_WP.y(), p_WP.z()}),
                                     glm::vec3(0.0f));
    const RTCHit16& hit = packet.hit;
    LaneMask mask;
    for (int i = 0; i < count; ++i) {
      const float dx = p_WP.x() - to_point.org_x[i];
      const float dy = p_WP.y() - to_point.org_y[i];
      const float dz = p_WP.z() - to_point.org_z[i];
      const float to_viewer =
          -(hit.Ng_x[i] * packet.ray.dir_x[i] + hit.Ng_y[i] * packet.ray.dir_y[i] +
            hit.Ng_z[i] * packet.ray.dir_z[i]);
      const float to_p = hit.Ng_x[i] * dx + hit.Ng_y[i] * dy + hit.Ng_z[i] * dz;
      const bool hits = hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      mask[i] = hits && to_viewer * to_p > 0.0f ? -1 : 0;
      to_point.dir_x[i] = dx;
      to_point.dir_y[i] = dy;
      to_point.dir_z[i] = dz;
      to_point.tfar[i] = 1.0f;
    }
    traced_.opaque_tracer().Occlude(mask, to_point, Coherence::kCoherent);
    for (int i = 0; i < count; ++i) {
      const bool sees = mask[i] != 0 && to_point.tfar[i] > 0.0f;
      images_.sees_point(row, first_column + i) = sees ? 255 : 0;
    }
  }

  const Scene& scene_;
  const TracedScene& traced_;
  const LightTransport& light_;
  const RayGrid& rays_;
  const Pose& X_WC_;
  FloatPose camera_;
  const AovOptions& options_;
  AovImages images_;
};

}  // namespace

AovImages CastAovImages(const Scene& scene, const TracedScene& traced, const LightTransport& light,
                        const RayGrid& rays, const Pose& X_WC, const AovOptions& options) {
  Check(options, {rays.width_px(), rays.height_px()});
  return AovCaster(scene, traced, light, rays, X_WC, options).Cast();
}

}  // namespace fenestra
