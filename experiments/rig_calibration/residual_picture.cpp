#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "experiments/output/plot.h"
#include "experiments/rig_calibration/calibration_report.h"

namespace fenestra {
namespace {

constexpr int kPanelWidth = 680;
constexpr int kScatterHeight = 460;

// Arrows are magnified so that the usual one is this long, to a round factor [px of the image].
constexpr double kUsualArrow_px = 18.0;

double Magnification(double rms_px) {
  const double raw = kUsualArrow_px / std::max(rms_px, 1e-6);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double digit = raw / power;
  return power * (digit < 2.0 ? 1.0 : digit < 5.0 ? 2.0 : 5.0);
}

void DrawField(cv::Mat3b& canvas, const cv::Rect& area, const std::string& name,
               const CameraModel& camera, const std::vector<CornerResidual>& residuals,
               double magnification) {
  Plot plot(
      canvas,
      {.area = area,
       .title = fmt::format("{} camera: residuals where they are, x {:g}", name, magnification),
       .x = {"u [px]", 0.0, static_cast<double>(camera.width_px())},
       // Image rows run downwards.
       .y = {"rows from the bottom [px]", 0.0, static_cast<double>(camera.height_px())}});
  std::vector<cv::Point2d> feet;
  for (const CornerResidual& r : residuals) {
    const auto place = [&](const Eigen::Vector2d& pixel) {
      return cv::Point2d(pixel.x(), camera.height_px() - pixel.y());
    };
    const cv::Point2d foot = place(r.pixel);
    const std::array<cv::Point2d, 2> arrow = {foot, place(r.pixel + magnification * r.residual_px)};
    plot.Line(arrow, plot_color::kVermilion, "", 1);
    feet.push_back(foot);
  }
  for (const cv::Point2d& foot : feet) plot.Points({&foot, 1}, plot_color::kBlue);
}

void DrawScatter(cv::Mat3b& canvas, const cv::Rect& area,
                 const std::vector<CornerResidual>& residuals, double deviation_px, double reach) {
  Plot plot(canvas, {.area = area,
                     .title = fmt::format("{} corners, RMS of a coordinate {:.3f} px",
                                          residuals.size(), deviation_px),
                     .x = {"du [px]", -reach, reach},
                     .y = {"-dv [px]", -reach, reach}});
  std::vector<cv::Point2d> points;
  for (const CornerResidual& r : residuals)
    points.emplace_back(r.residual_px.x(), -r.residual_px.y());
  plot.Points(points, plot_color::kBlue);
  for (const double sigmas : {1.0, 2.0}) {
    std::vector<cv::Point2d> circle;
    for (int i = 0; i <= 72; ++i) {
      const double angle = i * CV_2PI / 72.0;
      circle.emplace_back(sigmas * deviation_px * std::cos(angle),
                          sigmas * deviation_px * std::sin(angle));
    }
    plot.Line(circle, plot_color::kVermilion, sigmas == 1.0 ? "1 and 2 sigma" : "", 1);
  }
}

}  // namespace

cv::Mat3b ResidualPicture(const StereoCalibrationResult& result) {
  const CameraModel& left = result.calibration.left;
  const int field_height =
      static_cast<int>((kPanelWidth - 84) * static_cast<double>(left.height_px()) /
                       left.width_px()) +
      72;
  cv::Mat3b canvas = WhiteCanvas({2 * kPanelWidth, field_height + kScatterHeight});
  const double magnification = Magnification(result.rms_px);
  for (size_t i = 0; i < 2; ++i) {
    const CameraModel& camera = i == 0 ? left : result.calibration.right;
    const double deviation_px = result.camera_rms_px[i] / std::sqrt(2.0);
    const int x = static_cast<int>(i) * kPanelWidth;
    DrawField(canvas, {x, 0, kPanelWidth, field_height}, i == 0 ? "Left" : "Right", camera,
              result.residuals[i], magnification);
    const cv::Rect scatter(x + (kPanelWidth - kScatterHeight) / 2, field_height, kScatterHeight,
                           kScatterHeight);
    DrawScatter(canvas, scatter, result.residuals[i], deviation_px,
                std::max(4.0 * result.rms_px, 1e-6));
  }
  return canvas;
}

}  // namespace fenestra
