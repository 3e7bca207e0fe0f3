#include "experiments/depth_curves/wall_setup.h"

#include <Eigen/QR>
#include <cmath>

#include "scenes/targets/flat_targets.h"

namespace fenestra {
namespace {

Scene Wall(double reflectance_830nm, const WallSetup::Plate& plate) {
  PaperTargetOptions options;
  options.with_target = false;
  Scene scene = MakePaperTarget(options);
  for (Material& material : scene.materials) {
    material.reflectance_830nm = static_cast<float>(reflectance_830nm);
  }
  if (plate.half_width_m > 0.0) {
    const auto x = static_cast<float>(plate.half_width_m * std::cos(plate.turn_rad));
    const auto dz = static_cast<float>(plate.half_width_m * std::sin(plate.turn_rad));
    const auto y = static_cast<float>(plate.half_width_m);
    const auto z = static_cast<float>(plate.stand_off_m);
    scene.meshes.push_back(
        {.name = "plate",
         .positions_W = {{-x, -y, z - dz}, {x, -y, z + dz}, {x, y, z + dz}, {-x, y, z - dz}},
         .triangles = {{0, 1, 2}, {0, 2, 3}},
         .material = scene.meshes.front().material});
  }
  return scene;
}

Lighting UnderSky(double lux) {
  Lighting lighting;
  lighting.sky.illuminance_lx = lux;
  return lighting;
}

// Far from a plate the wall is as bright as it is without one.
double WallPerSky(const Scene& wall) {
  const RayCaster caster(wall);
  const RayGrid rays(CameraModel::Pinhole(16, 16, 16.0));
  const AovImages seen =
      caster.CastAovs(rays, RigPose({.distance_m = 1.0}, Pose()), UnderSky(1000.0), {});
  return static_cast<double>(seen.irradiance_lx(8, 8)) / 1000.0;
}

}  // namespace

WallSetup::WallSetup(const StructuredLightOptions& options, double reflectance_830nm,
                     const Plate& plate, const RandomStream& stream)
    : sensor_(options),
      caster_(Wall(reflectance_830nm, plate)),
      stream_(stream),
      wall_per_sky_(WallPerSky(Wall(reflectance_830nm, {}))) {}

DepthImage WallSetup::See(const Viewpoint& viewpoint, double wall_lx, uint64_t image) const {
  return sensor_
      .ObserveDepth(caster_, UnderSky(wall_lx / wall_per_sky_), RigPose(viewpoint, Pose()),
                    stream_.Child("view", image))
      .depth;
}

double WallSetup::TemporalNoise(const Viewpoint& viewpoint) const {
  // The sensor's own averaging of images shares the laser's speckle among them; so do these.
  constexpr int kImages = 12;
  StructuredLightOptions averaging = sensor_.options();
  averaging.averaged_frames = kImages;
  const DepthImage mean = StructuredLightSensor(averaging)
                              .ObserveDepth(caster_, UnderSky(kIndoors_lx / wall_per_sky_),
                                            RigPose(viewpoint, Pose()), stream_.Child("view", 0))
                              .depth;
  const DepthImage one = See(viewpoint);
  double sum = 0.0;
  int count = 0;
  const cv::Rect middle = MiddleOf(one.raw);
  for (int v = middle.y; v < middle.br().y; ++v) {
    for (int u = middle.x; u < middle.br().x; ++u) {
      if (one.raw(v, u) == 0 || mean.raw(v, u) == 0) continue;
      sum += std::pow((one.raw(v, u) - mean.raw(v, u)) * one.unit_m, 2);
      ++count;
    }
  }
  // The one image is a part of the mean.
  return std::sqrt(sum / count * kImages / (kImages - 1.0));
}

cv::Rect MiddleOf(const cv::Mat& image) {
  return {image.cols / 4, image.rows / 4, image.cols / 2, image.rows / 2};
}

double ValidShare(const DepthImage& depth) {
  const cv::Rect middle = MiddleOf(depth.raw);
  return cv::countNonZero(depth.raw(middle)) / static_cast<double>(middle.area());
}

double PlaneResidual(const DepthImage& depth) {
  // A plane's inverse depth is linear in the image: least squares, then what is left in depth.
  const cv::Rect middle = MiddleOf(depth.raw);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto visit = [&](auto act) {
    for (int v = middle.y; v < middle.br().y; ++v) {
      for (int u = middle.x; u < middle.br().x; ++u) {
        if (depth.raw(v, u) == 0) continue;
        act(Eigen::Vector3d((u - 0.5 * depth.raw.cols) / depth.raw.cols,
                            (v - 0.5 * depth.raw.rows) / depth.raw.cols, 1.0),
            depth.raw(v, u) * depth.unit_m);
      }
    }
  };
  visit([&](const Eigen::Vector3d& x, double z_m) {
    normal += x * x.transpose();
    right += x / z_m;
  });
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  double sum = 0.0;
  int count = 0;
  visit([&](const Eigen::Vector3d& x, double z_m) {
    sum += std::pow(z_m - 1.0 / plane.dot(x), 2);
    ++count;
  });
  return count > 0 ? std::sqrt(sum / count) : NAN;
}

}  // namespace fenestra
