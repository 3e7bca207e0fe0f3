#include "experiments/trial_files/truth_exr.h"

#include <fmt/format.h>

#include <array>

#include "core/detection/detection_json.h"

namespace fenestra {
namespace {

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

void WriteTruthExr(const std::filesystem::path& file, const TruthImages& truth,
                   const std::string& point) {
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
