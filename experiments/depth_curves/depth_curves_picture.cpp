#include "experiments/depth_curves/depth_curves_picture.h"

#include <cmath>

#include "core/geometry/pose.h"
#include "experiments/depth_curves/depth_laws.h"
#include "experiments/output/plot.h"

namespace fenestra {
namespace {

using Points = std::vector<cv::Point2d>;

// The place of a plot among six, in two rows of three.
cv::Rect AreaOf(int column, int row) {
  return {column * 600, row * 450, 600, 450};
}

template <typename Law>
Points LawOver(double from, double to, const Law& law) {
  constexpr int kPoints = 100;
  Points points;
  for (int i = 0; i <= kPoints; ++i) {
    const double x = from + (to - from) * i / kPoints;
    points.emplace_back(x, law(x));
  }
  return points;
}

struct Models {
  const DepthCurves& parametric;
  const DepthCurves& speckle;

  template <typename PointsOf>
  void Draw(Plot& plot, const PointsOf& points_of) const {
    plot.Points(points_of(parametric), plot_color::kGreen, "parametric");
    plot.Points(points_of(speckle), plot_color::kBlue, "speckle");
  }
};

void DrawNoise(cv::Mat3b& canvas, const Models& models) {
  Plot plot(canvas, {.area = AreaOf(0, 0),
                     .title = "Noise and fixed pattern of a white wall",
                     .x = {"distance [m]", 0.5, 7.5},
                     .y = {"RMS around the plane [mm]", 0.0, 100.0}});
  plot.Line(LawOver(0.8, 7.2, [](double z) { return 1e3 * KhoshelhamSigma(z); }),
            plot_color::kVermilion, "Khoshelham & Elberink 2012");
  models.Draw(plot, [](const DepthCurves& c) {
    Points points;
    for (const auto& d : c.by_distance) points.emplace_back(d.z_m, 1e3 * d.residual_m);
    return points;
  });
}

void DrawIncidence(cv::Mat3b& canvas, const Models& models) {
  Plot plot(canvas, {.area = AreaOf(1, 0),
                     .title = "White wall at 1.5 m, by incidence",
                     .x = {"angle [deg]", 0.0, 85.0},
                     .y = {"RMS around the plane [mm]", 0.0, 30.0}});
  plot.Line(LawOver(0.0, 80.0, [](double deg) { return 1e3 * NguyenSigma(1.5, deg * kDegree); }),
            plot_color::kVermilion, "Nguyen et al. 2012");
  models.Draw(plot, [](const DepthCurves& c) {
    Points points;
    for (const auto& i : c.by_incidence) {
      points.emplace_back(i.angle_rad / kDegree, 1e3 * i.residual_m);
    }
    return points;
  });
}

void DrawLateral(cv::Mat3b& canvas, const Models& models) {
  Plot plot(canvas, {.area = AreaOf(2, 0),
                     .title = "Right border of a plate at 1.5 m",
                     .x = {"angle of the plate [deg]", 0.0, 85.0},
                     .y = {"RMS around the line [px]", 0.0, 3.0}});
  plot.Line(LawOver(0.0, 75.0, [](double deg) { return NguyenLateralSigma(deg * kDegree); }),
            plot_color::kVermilion, "Nguyen et al. 2012");
  models.Draw(plot, [](const DepthCurves& c) {
    Points points;
    for (const auto& l : c.lateral) points.emplace_back(l.angle_rad / kDegree, l.right_px);
    return points;
  });
}

void DrawAmbient(cv::Mat3b& canvas, const Models& models) {
  Plot plot(canvas, {.area = AreaOf(0, 1),
                     .title = "Daylight on a white wall at 3 m",
                     .x = {"on the wall [lx]", 80.0, 3e5, true},
                     .y = {"valid pixels [%]", 0.0, 130.0}});
  plot.VerticalMark(PredictedAmbientLimit({}, 0.8, 3.0), "predicted");
  models.Draw(plot, [](const DepthCurves& c) {
    Points points;
    for (const auto& a : c.by_ambient) {
      if (a.z_m == 3.0) points.emplace_back(a.wall_lx, 100.0 * a.valid);
    }
    return points;
  });
}

void DrawPaint(cv::Mat3b& canvas, const Models& models) {
  Plot plot(canvas, {.area = AreaOf(1, 1),
                     .title = "Black paint, reflectance 0.05 at 830 nm",
                     .x = {"distance [m]", 1.0, 8.5},
                     .y = {"valid pixels [%]", 0.0, 130.0}});
  plot.VerticalMark(PredictedReach({}, 0.05), "predicted");
  models.Draw(plot, [](const DepthCurves& c) {
    Points points;
    for (const auto& p : c.by_paint) {
      if (p.reflectance_830nm == 0.05) points.emplace_back(p.z_m, 100.0 * p.valid);
    }
    return points;
  });
}

void DrawShadows(cv::Mat3b& canvas, const Models& models) {
  Plot plot(canvas, {.area = AreaOf(2, 1),
                     .title = "Shadow left of a plate",
                     .x = {"f b (1/z_o - 1/z_b) [px]", 0.0, 36.0},
                     .y = {"no return [px]", 0.0, 40.0}});
  plot.Line(LawOver(0.0, 36.0, [](double px) { return px; }), plot_color::kVermilion, "geometry");
  models.Draw(plot, [](const DepthCurves& c) {
    Points points;
    for (const auto& s : c.shadows) {
      points.emplace_back(ShadowWidth({}, s.plate_m, s.wall_m), s.left_px);
    }
    return points;
  });
}

}  // namespace

cv::Mat3b DepthCurvesPicture(const DepthCurves& parametric, const DepthCurves& speckle) {
  cv::Mat3b canvas = WhiteCanvas({1800, 900});
  const Models models{parametric, speckle};
  DrawNoise(canvas, models);
  DrawIncidence(canvas, models);
  DrawLateral(canvas, models);
  DrawAmbient(canvas, models);
  DrawPaint(canvas, models);
  DrawShadows(canvas, models);
  return canvas;
}

}  // namespace fenestra
