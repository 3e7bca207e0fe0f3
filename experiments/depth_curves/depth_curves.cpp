#include "experiments/depth_curves/depth_curves.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/geometry/pose.h"
#include "experiments/depth_curves/wall_setup.h"

namespace fenestra {
namespace {

constexpr double kTilt = 1.0 * kDegree;

// As many depth pixels as the infra-red image has.
StructuredLightOptions InFullResolution(StructuredLightOptions options) {
  const int scale = options.infrared_width_px / options.depth_width_px;
  options.depth_width_px *= scale;
  options.depth_height_px *= scale;
  options.depth_focal_px *= scale;
  return options;
}

// RMS of places around their straight line.
double RoughnessOf(const std::vector<double>& places) {
  const auto n = static_cast<double>(places.size());
  if (n < 3) return NAN;
  const double middle = 0.5 * (n - 1);
  double mean = 0.0;
  double moment = 0.0;
  double spread = 0.0;
  for (size_t i = 0; i < places.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    mean += places[i] / n;
    moment += x * places[i];
    spread += x * x;
  }
  double sum = 0.0;
  for (size_t i = 0; i < places.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    sum += std::pow(places[i] - mean - moment / spread * x, 2);
  }
  return std::sqrt(sum / (n - 2));
}

// The outermost returns nearer than `between_m` of each row across the middle, in a 640-wide image.
// The rows all cross both upright borders, of which the far one is the shorter.
DepthCurves::Lateral BordersOf(const DepthImage& depth, double between_m) {
  std::vector<double> left;
  std::vector<double> right;
  const double to_640 = 640.0 / depth.raw.cols;
  for (int v = depth.raw.rows * 3 / 8; v < depth.raw.rows * 5 / 8; ++v) {
    int first = -1;
    int last = -1;
    for (int u = 0; u < depth.raw.cols; ++u) {
      const double z_m = depth.raw(v, u) * depth.unit_m;
      if (z_m == 0.0 || z_m > between_m) continue;
      if (first < 0) first = u;
      last = u;
    }
    if (first < 0) continue;
    left.push_back(to_640 * first);
    right.push_back(to_640 * last);
  }
  return {.angle_rad = 0.0, .left_px = RoughnessOf(left), .right_px = RoughnessOf(right)};
}

// Between the depths around z that occur on a wall at 35°. Seen from several distances, so that
// even in an image of few columns no depth is left out.
double StepAt(const StructuredLightOptions& options, double z_m, const RandomStream& stream) {
  constexpr int kViews = 8;
  constexpr double kSpacing = 0.00125;
  const WallSetup wall(options, WallSetup::kWhite, {}, stream);
  std::set<uint16_t> levels;
  double unit_m = 0.0;
  for (int i = 0; i < kViews; ++i) {
    const DepthImage depth =
        wall.See({.distance_m = z_m * (1.0 + kSpacing * i), .azimuth_rad = 35.0 * kDegree});
    unit_m = depth.unit_m;
    for (const uint16_t raw : depth.raw) {
      if (std::abs(raw * unit_m - z_m) < 0.06 * z_m) levels.insert(raw);
    }
  }
  if (levels.size() < 3) return NAN;
  return (*levels.rbegin() - *levels.begin()) * unit_m / static_cast<double>(levels.size() - 1);
}

std::vector<DepthCurves::Step> MeasureSteps(StructuredLightOptions options,
                                            const RandomStream& stream) {
  std::vector<DepthCurves::Step> steps;
  for (const double z_m : {1.0, 1.5, 2.0, 3.0, 3.7}) {
    options.driver = DepthDriver::kOpenNi;
    const double open_ni_m = StepAt(options, z_m, stream);
    options.driver = DepthDriver::kMicrosoft;
    steps.push_back({z_m, open_ni_m, StepAt(options, z_m, stream)});
  }
  return steps;
}

DepthCurves::Shadow MeasureShadow(const StructuredLightOptions& options, double plate_m,
                                  double wall_m, const RandomStream& stream) {
  constexpr int kPlates = 6;
  DepthCurves::Shadow shadow{plate_m, wall_m, 0.0, 0.0};
  const StructuredLightOptions full = InFullResolution(options);
  for (int i = 0; i < kPlates; ++i) {
    // Outlines that cross pixels at different places.
    const double half_px = (60.0 + 13.37 * i) * full.depth_width_px / 640.0;
    const WallSetup wall(full, WallSetup::kWhite,
                         {.stand_off_m = wall_m - plate_m,
                          .half_width_m = plate_m * half_px / full.depth_focal_px,
                          .turn_rad = 0.0},
                         stream);
    const cv::Mat1w raw =
        wall.See({.distance_m = wall_m}, WallSetup::kIndoors_lx, static_cast<uint64_t>(i)).raw;
    // Rows across the plate; columns whose windows lie in the image.
    const cv::Rect rows(raw.cols / 32, raw.rows * 2 / 5, raw.cols * 15 / 16, raw.rows / 5);
    const cv::Mat1b holes = raw(rows) == 0;
    const double per_row = 640.0 / raw.cols / (255.0 * rows.height * kPlates);
    shadow.left_px += cv::sum(holes.colRange(0, rows.width / 2))[0] * per_row;
    shadow.right_px += cv::sum(holes.colRange(rows.width / 2, rows.width))[0] * per_row;
  }
  return shadow;
}

}  // namespace

double HalfPoint(const std::vector<cv::Point2d>& x_and_share) {
  for (size_t i = 1; i < x_and_share.size(); ++i) {
    const cv::Point2d& a = x_and_share[i - 1];
    const cv::Point2d& b = x_and_share[i];
    if (a.y < 0.5 || b.y >= 0.5) continue;
    const double t = (a.y - 0.5) / (a.y - b.y);
    return std::exp((1.0 - t) * std::log(a.x) + t * std::log(b.x));
  }
  return NAN;
}

std::vector<DepthCurves::Lateral> MeasureLateral(const StructuredLightOptions& options,
                                                 const RandomStream& stream) {
  constexpr double kPlate_m = 1.5;
  constexpr double kStandOff_m = 0.8;
  std::vector<DepthCurves::Lateral> curve;
  for (const double angle_deg : {0.0, 20.0, 40.0, 50.0, 60.0, 70.0}) {
    const WallSetup wall(
        InFullResolution(options), WallSetup::kWhite,
        {.stand_off_m = kStandOff_m, .half_width_m = 0.35, .turn_rad = angle_deg * kDegree},
        stream);
    DepthCurves::Lateral at =
        BordersOf(wall.See({.distance_m = kPlate_m + kStandOff_m}), kPlate_m + 0.6 * kStandOff_m);
    at.angle_rad = angle_deg * kDegree;
    curve.push_back(at);
  }
  return curve;
}

DepthCurves MeasureDepthCurves(const StructuredLightOptions& options, const RandomStream& stream) {
  DepthCurves curves;
  const WallSetup white(options, WallSetup::kWhite, {}, stream);
  for (const double z_m : {0.9, 1.25, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}) {
    const Viewpoint viewpoint{.distance_m = z_m, .azimuth_rad = kTilt};
    const DepthImage depth = white.See(viewpoint);
    curves.by_distance.push_back({.z_m = z_m,
                                  .residual_m = PlaneResidual(depth),
                                  .temporal_m = white.TemporalNoise(viewpoint),
                                  .valid = ValidShare(depth)});
  }
  for (const double angle_deg : {0.0, 20.0, 40.0, 50.0, 60.0, 65.0, 70.0, 75.0, 80.0}) {
    const DepthImage depth = white.See({.distance_m = 1.5, .azimuth_rad = angle_deg * kDegree});
    curves.by_incidence.push_back({.angle_rad = angle_deg * kDegree,
                                   .residual_m = PlaneResidual(depth),
                                   .valid = ValidShare(depth)});
  }
  curves.lateral = MeasureLateral(options, stream);
  curves.steps = MeasureSteps(options, stream);
  for (const double z_m : {1.0, 2.0, 3.0}) {
    for (const double lux : {100.0, 1e3, 5e3, 1e4, 2e4, 3e4, 4e4, 6e4, 8e4, 1e5, 2e5}) {
      curves.by_ambient.push_back(
          {.wall_lx = lux, .z_m = z_m, .valid = ValidShare(white.See({.distance_m = z_m}, lux))});
    }
  }
  for (const double reflectance : {0.05, 0.10, 0.20, 0.40}) {
    const WallSetup painted(options, reflectance, {}, stream);
    for (const double z_m : {1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0, 7.0, 8.0}) {
      curves.by_paint.push_back({.reflectance_830nm = reflectance,
                                 .z_m = z_m,
                                 .valid = ValidShare(painted.See({.distance_m = z_m}))});
    }
  }
  for (const auto& [plate_m, wall_m] :
       {std::pair{1.7, 2.0}, {1.5, 2.0}, {1.2, 2.0}, {2.0, 3.0}, {1.5, 3.0}, {0.9, 3.0}}) {
    curves.shadows.push_back(MeasureShadow(options, plate_m, wall_m, stream));
  }
  return curves;
}

}  // namespace fenestra
