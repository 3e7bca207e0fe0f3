#include "experiments/trial_files/truth_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/detection/detection_json.h"

namespace fenestra {
namespace {

constexpr int kPointsPerSide = 64;

enum class Sight { kVisible, kHidden, kTooNarrow };

/// The front outer rectangle of a window: p_C = p_CO + x right + y down.
struct Front {
  explicit Front(const WindowTruth& window)
      : p_CO(window.p_CO),
        normal_C(window.normal_C),
        right_C((window.p_CV[1] - window.p_CV[0]).normalized()),
        down_C((window.p_CV[3] - window.p_CV[0]).normalized()),
        half_m(0.5 * Eigen::Vector2d(window.width_m, window.height_m)) {}

  Eigen::Vector3d At(const Eigen::Vector2d& p) const {
    return p_CO + p.x() * right_C + p.y() * down_C;
  }

  /// Whether a point of the plane is on the border.
  bool OnBorder(const Eigen::Vector3d& p_C, double border_m) const {
    const Eigen::Vector2d p(std::abs(right_C.dot(p_C - p_CO)), std::abs(down_C.dot(p_C - p_CO)));
    const Eigen::Array2d inside_m = (half_m - p).array();
    return inside_m.minCoeff() >= 0.0 && inside_m.minCoeff() <= border_m;
  }

  Eigen::Vector3d p_CO, normal_C, right_C, down_C;
  Eigen::Vector2d half_m;
};

Sight SightOf(const TruthImages& images, const Front& front, const Eigen::Vector2d& p,
              double border_m) {
  const auto pixel = images.camera.Project(front.At(p));
  if (!pixel || !images.camera.Contains(*pixel)) return Sight::kHidden;
  const int u =
      std::clamp(static_cast<int>(std::lround(pixel->x())), 0, images.camera.width_px() - 1);
  const int v =
      std::clamp(static_cast<int>(std::lround(pixel->y())), 0, images.camera.height_px() - 1);
  const auto ray = images.camera.UnprojectRay({u, v});
  if (!ray) return Sight::kHidden;
  const double z_m = front.normal_C.dot(front.p_CO) / front.normal_C.dot(*ray);
  if (!front.OnBorder(z_m * *ray, border_m)) return Sight::kTooNarrow;
  // Depth images are of floats; nothing that matters is thinner than this.
  const double tolerance_m = 1e-3 + 1e-5 * z_m;
  const double seen_m = static_cast<double>(images.aovs.depth_m(v, u));
  return seen_m < z_m - tolerance_m ? Sight::kHidden : Sight::kVisible;
}

using nlohmann::ordered_json;

ordered_json WindowJson(const WindowTruth& window) {
  return {{"centroid_m", ToJson(window.p_CO)},
          {"corners_m", ToJson(window.p_CV)},
          {"normal", ToJson(window.normal_C)},
          {"width_m", window.width_m},
          {"height_m", window.height_m}};
}

// The frame O of a window: x right and y up along its sides, z its normal.
Pose X_CO(const WindowTruth& window) {
  Eigen::Matrix3d R_CO;
  R_CO.col(0) = (window.p_CV[1] - window.p_CV[0]).normalized();
  R_CO.col(2) = window.normal_C;
  R_CO.col(1) = R_CO.col(2).cross(R_CO.col(0));
  return Pose(R_CO, window.p_CO);
}

ordered_json CornersPx(const WindowTruth& window, const Pose& X_WC, const NamedCamera& camera) {
  const Pose X_KC = camera.X_WC.inverse() * X_WC;
  ordered_json corners = ordered_json::array();
  for (const Eigen::Vector3d& p_CV : window.p_CV) {
    const auto pixel = camera.camera.Project(X_KC * p_CV);
    corners.push_back(pixel ? ordered_json{pixel->x(), pixel->y()} : ordered_json());
  }
  return corners;
}

ordered_json Windows(const GroundTruth& truth) {
  ordered_json json = {{"target_in_view", truth.in_view},
                       {"target", truth.target ? WindowJson(*truth.target) : ordered_json()},
                       {"other_windows", ordered_json::array()}};
  for (const WindowTruth& window : truth.other_windows) {
    json["other_windows"].push_back(WindowJson(window));
  }
  return json;
}

cv::Mat1f AsFloat(const cv::Mat& image, double scale = 1.0) {
  cv::Mat1f converted;
  image.convertTo(converted, CV_32F, scale);
  return converted;
}

// OpenEXR has 8-bit flags as floats, too.
cv::Mat1f AsFlag(const cv::Mat1b& image) {
  return AsFloat(image, 1.0 / 255.0);
}

}  // namespace

double VisibleShare(const TruthImages& images, const WindowTruth& window, double border_m) {
  const Front front(window);
  if (front.normal_C.dot(front.p_CO) >= 0.0) return 0.0;  // Seen from behind.
  const Eigen::Vector2d middle = front.half_m.array() - 0.5 * border_m;
  int visible = 0;
  int hidden = 0;
  for (int i = 0; i < kPointsPerSide; ++i) {
    const double along = -1.0 + 2.0 * (i + 0.5) / kPointsPerSide;
    for (const double side : {-1.0, 1.0}) {
      for (const Eigen::Vector2d& place :
           {Eigen::Vector2d(along, side), Eigen::Vector2d(side, along)}) {
        const Sight sight = SightOf(images, front, place.cwiseProduct(middle), border_m);
        visible += sight == Sight::kVisible;
        hidden += sight == Sight::kHidden;
      }
    }
  }
  return visible == 0 ? 0.0 : static_cast<double>(visible) / (visible + hidden);
}

std::string TruthJson(const GroundTruth& truth, const std::string& camera,
                      const Eigen::Vector3d& p_FW) {
  ordered_json json = {{"world_origin_in_file_m", ToJson(p_FW)},
                       {"world_from_" + camera, ToJson(truth.X_WC)}};
  json.update(Windows(truth));
  return json.dump(2) + "\n";
}

std::string TruthJson(const GroundTruth& truth, std::span<const NamedCamera> cameras,
                      std::optional<double> target_visible_share) {
  ordered_json json = {{"camera", cameras.front().name}};
  for (const NamedCamera& camera : cameras) {
    json["world_from_" + camera.name] = ToJson(camera.X_WC);
  }
  if (truth.target) {
    json["world_from_target"] = ToJson(truth.X_WC * X_CO(*truth.target));
    json["target_visible_share"] = target_visible_share.value();
  }
  json.update(Windows(truth));
  if (truth.target) {
    for (const NamedCamera& camera : cameras) {
      json["target"]["corners_px"][camera.name] = CornersPx(*truth.target, truth.X_WC, camera);
    }
  }
  return json.dump(2) + "\n";
}

std::vector<ExrChannel> AovChannels(const AovImages& aovs, const std::string& point) {
  std::array<cv::Mat1f, 3> normal;
  cv::split(aovs.normal_C, normal.data());
  std::vector<ExrChannel> channels = {{"depth.Z", aovs.depth_m},
                                      {"normal.X", normal[0]},
                                      {"normal.Y", normal[1]},
                                      {"normal.Z", normal[2]},
                                      {"object.ID", AsFloat(aovs.object_id)},
                                      {"material.ID", AsFloat(aovs.material_id)},
                                      {"irradiance.lx", aovs.irradiance_lx},
                                      {"irradiance.830nm", aovs.irradiance_830},
                                      {"reflectance.830nm", aovs.reflectance_830nm},
                                      {"transmittance.T", aovs.transmittance},
                                      {"sun.V", AsFlag(aovs.sees_sun)}};
  if (!aovs.sees_point.empty()) channels.push_back({point + ".V", AsFlag(aovs.sees_point)});
  return channels;
}

std::vector<ExrChannel> RadianceChannels(const cv::Mat& radiance, Band band) {
  if (band == Band::kLuminance) return {{"Y", radiance}};
  if (band == Band::kInfrared) return {{"infrared.Y", radiance}};
  std::array<cv::Mat1f, 3> bgr;
  cv::split(radiance, bgr.data());
  return {{"B", bgr[0]}, {"G", bgr[1]}, {"R", bgr[2]}};
}

std::map<std::string, std::string> CameraMetadata(const CameraModel& camera, const Pose& X_WC) {
  const CameraParameters& p = camera.parameters();
  const BrownConrady& d = p.distortion;
  return {
      {"camera_intrinsics_px",
       fmt::format("fx {} fy {} cx {} cy {}", p.fx_px, p.fy_px, p.cx_px, p.cy_px)},
      {"camera_distortion",
       fmt::format("Brown-Conrady k1 {} k2 {} p1 {} p2 {} k3 {}", d.k1, d.k2, d.p1, d.p2, d.k3)},
      {"world_from_camera", ToJson(X_WC).dump()},
      {"frames",
       "camera: +x right, +y down, +z forward, integer pixels are centres; world: +Y up; metres"},
      {"radiance", "R, G, B, Y [cd/m^2]; infrared.Y at 830 nm [W/(m^2 sr nm)]"},
      {"depth", "Z along the optical axis [m]; NaN: nothing hit"},
      {"normal", "geometric unit normal in the camera frame; 0: nothing hit"},
      {"ids", "indices of object and material in the scene; -1: nothing hit"},
      {"irradiance", "by all lights on the surface: lx; at 830 nm [W/(m^2 nm)]"},
      {"transmittance", "of the glass between camera and surface"},
      {"visibility", "channels V: 1 where the sun or the named point sees the surface"},
      {"disparity", "U, V [px]: this pixel minus its match; NaN: none"}};
}

void WriteTruthExr(const OutputPath& file, const TruthImages& truth, const std::string& point) {
  std::vector<ExrChannel> channels = AovChannels(truth.aovs, point);
  for (ExrChannel& channel : RadianceChannels(truth.radiance, truth.band)) {
    channels.push_back(std::move(channel));
  }
  std::array<cv::Mat1f, 2> disparity;
  cv::split(truth.disparity_px, disparity.data());
  channels.push_back({"disparity.U", disparity[0]});
  channels.push_back({"disparity.V", disparity[1]});
  WriteExr(file, channels, CameraMetadata(truth.camera, truth.X_WC));
}

}  // namespace fenestra
