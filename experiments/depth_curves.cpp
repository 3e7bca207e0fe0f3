#include "experiments/depth_curves.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>
#include <numbers>

#include "experiments/plot.h"
#include "experiments/text_table.h"
#include "scenes/paper_target.h"
#include "sim/viewpoint.h"

namespace fenestra {
namespace {

constexpr double kReference_lx = 300.0;  // Indoors.

Scene Wall(double reflectance_830nm) {
  PaperTargetOptions options;
  options.with_target = false;
  Scene scene = MakePaperTarget(options);
  for (Material& material : scene.materials) {
    material.reflectance_830nm = static_cast<float>(reflectance_830nm);
  }
  return scene;
}

cv::Rect MiddleOf(const cv::Mat& image) {
  return {image.cols / 4, image.rows / 4, image.cols / 2, image.rows / 2};
}

double ValidShare(const DepthImage& depth) {
  const cv::Rect middle = MiddleOf(depth.raw);
  return cv::countNonZero(depth.raw(middle)) / static_cast<double>(middle.area());
}

// A plane's inverse depth is linear in the image: least squares, then what is left in depth.
double PlaneResidual(const DepthImage& depth) {
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

// One sensor before walls of one paint.
class Bench {
 public:
  Bench(const StructuredLightOptions& options, double reflectance_830nm, const RandomStream& stream)
      : sensor_(options), caster_(Wall(reflectance_830nm)), stream_(stream) {}

  DepthImage See(const Viewpoint& viewpoint, double lux = kReference_lx, uint64_t frame = 0) const {
    Lighting lighting;
    lighting.sky.illuminance_lx = lux;
    return sensor_
        .ObserveDepth(caster_, lighting, RigPose(viewpoint, Pose()), stream_.Child("view", frame))
        .depth;
  }

  // RMS of a pixel's depth over frames around its mean, over pixels that always have a return. The
  // sensor's own averaging of frames shares the laser's speckle among them; so do these.
  double TemporalNoise(const StructuredLightOptions& options, const Viewpoint& viewpoint) const {
    constexpr int kFrames = 12;
    StructuredLightOptions averaging = options;
    averaging.averaged_frames = kFrames;
    Lighting lighting;
    lighting.sky.illuminance_lx = kReference_lx;
    const Pose X_WB = RigPose(viewpoint, Pose());
    const DepthImage mean = StructuredLightSensor(averaging)
                                .ObserveDepth(caster_, lighting, X_WB, stream_.Child("view", 0))
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
    // The one frame is a part of the mean.
    return std::sqrt(sum / count * kFrames / (kFrames - 1.0));
  }

 private:
  StructuredLightSensor sensor_;
  RayCaster caster_;
  RandomStream stream_;
};

constexpr double kWhite = 0.8;
constexpr double kDegree = std::numbers::pi / 180.0;

void AddRow(TextTable& table, std::vector<double> numbers, std::vector<double> percents) {
  std::vector<std::string> cells;
  for (const double x : numbers) {
    cells.push_back(std::isnan(x) ? "—" : fmt::format("{:.3g}", x));
  }
  for (const double x : percents) cells.push_back(fmt::format("{:.1f}", 100.0 * x));
  table.AddRow(std::move(cells));
}

TextTable TableWith(const std::vector<std::string>& headings) {
  TextTable table;
  for (const std::string& heading : headings) table.AddColumn(heading);
  return table;
}

}  // namespace

double KhoshelhamSigma(double z_m) {
  return 1.425e-3 * z_m * z_m;
}

double NguyenSigma(double z_m, double angle_rad) {
  const double axial = 0.0012 + 0.0019 * std::pow(z_m - 0.4, 2);
  if (angle_rad <= 60.0 * kDegree) return axial;
  return axial +
         0.0001 / std::sqrt(z_m) * std::pow(angle_rad / (std::numbers::pi / 2.0 - angle_rad), 2);
}

DepthCurves MeasureDepthCurves(const StructuredLightOptions& options, const RandomStream& stream) {
  DepthCurves curves;
  const Bench white(options, kWhite, stream);
  for (const double z_m : {0.9, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 3.9}) {
    const Viewpoint viewpoint{.distance_m = z_m, .azimuth_rad = 1.0 * kDegree};
    const DepthImage depth = white.See(viewpoint);
    curves.by_distance.push_back({.z_m = z_m,
                                  .residual_m = PlaneResidual(depth),
                                  .temporal_m = white.TemporalNoise(options, viewpoint),
                                  .valid = ValidShare(depth)});
  }
  for (const double angle_deg : {0.0, 20.0, 40.0, 50.0, 60.0, 65.0, 70.0, 75.0, 80.0}) {
    const DepthImage depth = white.See({.distance_m = 1.5, .azimuth_rad = angle_deg * kDegree});
    curves.by_incidence.push_back({.angle_rad = angle_deg * kDegree,
                                   .residual_m = PlaneResidual(depth),
                                   .valid = ValidShare(depth)});
  }
  for (const double z_m : {1.0, 2.0, 3.0}) {
    for (const double lux : {100.0, 1e3, 5e3, 1e4, 1.2e4, 1.4e4, 1.6e4, 2e4, 5e4}) {
      curves.by_ambient.push_back(
          {.lux = lux, .z_m = z_m, .valid = ValidShare(white.See({.distance_m = z_m}, lux))});
    }
  }
  for (const double reflectance : {0.05, 0.10, 0.20, 0.40}) {
    const Bench painted(options, reflectance, stream);
    for (const double z_m : {0.9, 1.1, 1.3, 1.5, 1.7, 1.9, 2.3, 2.7, 3.1, 3.5}) {
      curves.by_paint.push_back({.reflectance_830nm = reflectance,
                                 .z_m = z_m,
                                 .valid = ValidShare(painted.See({.distance_m = z_m}))});
    }
  }
  return curves;
}

std::string DepthCurvesMarkdown(const DepthCurves& parametric, const DepthCurves& speckle) {
  TextTable distance =
      TableWith({"distance [m]", "Khoshelham [mm]", "parametric [mm]", "speckle [mm]",
                 "temporal, parametric [mm]", "temporal, speckle [mm]", "valid, parametric [%]",
                 "valid, speckle [%]"});
  for (size_t i = 0; i < speckle.by_distance.size(); ++i) {
    const auto& p = parametric.by_distance[i];
    const auto& s = speckle.by_distance[i];
    AddRow(distance,
           {s.z_m, 1e3 * KhoshelhamSigma(s.z_m), 1e3 * p.residual_m, 1e3 * s.residual_m,
            1e3 * p.temporal_m, 1e3 * s.temporal_m},
           {p.valid, s.valid});
  }
  TextTable incidence = TableWith({"angle [deg]", "Nguyen [mm]", "parametric [mm]", "speckle [mm]",
                                   "valid, parametric [%]", "valid, speckle [%]"});
  for (size_t i = 0; i < speckle.by_incidence.size(); ++i) {
    const auto& p = parametric.by_incidence[i];
    const auto& s = speckle.by_incidence[i];
    AddRow(incidence,
           {s.angle_rad / kDegree, 1e3 * NguyenSigma(1.5, s.angle_rad), 1e3 * p.residual_m,
            1e3 * s.residual_m},
           {p.valid, s.valid});
  }
  TextTable ambient = TableWith(
      {"sky, horizontal [lx]", "distance [m]", "valid, parametric [%]", "valid, speckle [%]"});
  for (size_t i = 0; i < speckle.by_ambient.size(); ++i) {
    const auto& s = speckle.by_ambient[i];
    AddRow(ambient, {s.lux, s.z_m}, {parametric.by_ambient[i].valid, s.valid});
  }
  TextTable paint = TableWith(
      {"reflectance at 830 nm", "distance [m]", "valid, parametric [%]", "valid, speckle [%]"});
  for (size_t i = 0; i < speckle.by_paint.size(); ++i) {
    const auto& s = speckle.by_paint[i];
    AddRow(paint, {s.reflectance_830nm, s.z_m}, {parametric.by_paint[i].valid, s.valid});
  }
  return fmt::format(
      "# Depth of simulated walls\n\n## White wall, by distance\n\n{}\n## White wall at 1.5 m, by "
      "angle of incidence\n\n{}\n## White wall, by ambient light\n\n{}\n## Paint\n\n{}\n"
      "![Curves](depth_curves.png)\n",
      distance.ToMarkdown(), incidence.ToMarkdown(), ambient.ToMarkdown(), paint.ToMarkdown());
}

cv::Mat3b DepthCurvesPicture(const DepthCurves& parametric, const DepthCurves& speckle) {
  cv::Mat3b canvas = WhiteCanvas({1300, 940});
  const auto area = [](int column, int row) { return cv::Rect(column * 650, row * 470, 650, 470); };
  const auto models = [&](Plot& plot, const auto& points_of) {
    plot.Points(points_of(parametric), plot_color::kGreen, "parametric");
    plot.Points(points_of(speckle), plot_color::kBlue, "speckle");
  };
  using Points = std::vector<cv::Point2d>;

  Plot noise(canvas, {.area = area(0, 0),
                      .title = "Noise and fixed pattern of a white wall",
                      .x = {"distance [m]", 0.5, 4.2},
                      .y = {"RMS around the plane [mm]", 0.0, 45.0}});
  Points published;
  for (double z_m = 0.8; z_m <= 4.0; z_m += 0.05) {
    published.emplace_back(z_m, 1e3 * KhoshelhamSigma(z_m));
  }
  noise.Line(published, plot_color::kVermilion, "Khoshelham & Elberink 2012");
  models(noise, [](const DepthCurves& c) {
    Points points;
    for (const auto& d : c.by_distance) points.emplace_back(d.z_m, 1e3 * d.residual_m);
    return points;
  });

  Plot incidence(canvas, {.area = area(1, 0),
                          .title = "White wall at 1.5 m, by incidence",
                          .x = {"angle [deg]", 0.0, 85.0},
                          .y = {"RMS around the plane [mm]", 0.0, 30.0}});
  published.clear();
  for (double deg = 0.0; deg <= 80.0; deg += 1.0) {
    published.emplace_back(deg, 1e3 * NguyenSigma(1.5, deg * kDegree));
  }
  incidence.Line(published, plot_color::kVermilion, "Nguyen et al. 2012");
  models(incidence, [](const DepthCurves& c) {
    Points points;
    for (const auto& i : c.by_incidence) {
      points.emplace_back(i.angle_rad / kDegree, 1e3 * i.residual_m);
    }
    return points;
  });

  Plot ambient(canvas, {.area = area(0, 1),
                        .title = "Ambient light on a white wall at 2 m",
                        .x = {"sky, on level ground [lx]", 80.0, 6e4, true},
                        .y = {"valid pixels [%]", 0.0, 130.0}});
  models(ambient, [](const DepthCurves& c) {
    Points points;
    for (const auto& a : c.by_ambient) {
      if (a.z_m == 2.0) points.emplace_back(a.lux, 100.0 * a.valid);
    }
    return points;
  });

  Plot paint(canvas, {.area = area(1, 1),
                      .title = "Black paint, reflectance 0.05 at 830 nm",
                      .x = {"distance [m]", 0.8, 3.6},
                      .y = {"valid pixels [%]", 0.0, 130.0}});
  models(paint, [](const DepthCurves& c) {
    Points points;
    for (const auto& p : c.by_paint) {
      if (p.reflectance_830nm == 0.05) points.emplace_back(p.z_m, 100.0 * p.valid);
    }
    return points;
  });
  return canvas;
}

}  // namespace fenestra
