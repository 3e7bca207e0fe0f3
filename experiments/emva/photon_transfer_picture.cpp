#include "experiments/emva/photon_transfer_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/output/plot.h"

namespace fenestra::emva {
namespace {

const cv::Size kPanel(640, 460);

cv::Rect PanelAt(int column, int row) {
  return {{column * kPanel.width, row * kPanel.height}, kPanel};
}

template <typename Value>
std::vector<cv::Point2d> Curve(const std::vector<TransferPoint>& points, Value value) {
  std::vector<cv::Point2d> curve;
  for (const TransferPoint& p : points) curve.push_back(value(p));
  return curve;
}

void DrawTransfer(cv::Mat3b& canvas, const Results& r) {
  const double full = r.points[r.saturation_point].signal();
  double most = 0.0;
  for (const TransferPoint& p : r.points) most = std::max(most, p.light_variance());
  Plot plot(canvas, {.area = PanelAt(0, 0),
                     .title = fmt::format("Photon transfer: K = {:.4g} DN/e", r.gain_dn_per_e),
                     .x = {"signal above dark [DN]", 0.0, 1.1 * full},
                     .y = {"temporal variance above dark [DN^2]", 0.0, 1.15 * most}});
  const double fitted = r.points[r.last_fit_point].signal();
  const std::vector<cv::Point2d> line = {{0.0, 0.0}, {fitted, r.gain_dn_per_e * fitted}};
  plot.Points(
      Curve(r.points,
            [](const TransferPoint& p) { return cv::Point2d(p.signal(), p.light_variance()); }),
      plot_color::kBlue, "pairs of frames");
  plot.Line(line, plot_color::kVermilion, "slope K, up to 70 % of saturation");
  plot.VerticalMark(full, "saturation");
}

void DrawSensitivity(cv::Mat3b& canvas, const Results& r) {
  const double full = r.points[r.saturation_point].signal();
  Plot plot(canvas, {.area = PanelAt(1, 0),
                     .title = fmt::format("Response: quantum efficiency {:.1f} %",
                                          100.0 * r.quantum_efficiency),
                     .x = {"photons per pixel", 0.0, 1.02 * r.points.back().photons},
                     .y = {"signal above dark [DN]", 0.0, 1.15 * full}});
  const double fitted = r.points[r.last_fit_point].photons;
  const std::vector<cv::Point2d> line = {{0.0, 0.0}, {fitted, r.responsivity * fitted}};
  plot.Points(
      Curve(r.points, [](const TransferPoint& p) { return cv::Point2d(p.photons, p.signal()); }),
      plot_color::kBlue, "pairs of frames");
  plot.Line(line, plot_color::kVermilion, "slope R, up to 70 % of saturation");
  plot.VerticalMark(r.saturation_photons, "saturation");
}

void DrawSignalToNoise(cv::Mat3b& canvas, const Results& r) {
  const auto signal_to_noise = [](const TransferPoint& p) {
    return cv::Point2d(p.photons, p.signal() / std::sqrt(p.variance));
  };
  const double first = 0.5 * r.threshold_photons;
  const double last = 2.0 * r.saturation_photons;
  Plot plot(canvas, {.area = PanelAt(0, 1),
                     .title = fmt::format(
                         "Signal to noise: largest {:.1f} dB, dynamic range {:.1f} "
                         "dB",
                         20.0 * std::log10(r.largest_snr), 20.0 * std::log10(r.dynamic_range)),
                     .x = {"photons per pixel", first, last, true},
                     .y = {"signal to noise", 0.5, 3.0 * r.largest_snr, true}});
  std::vector<cv::Point2d> model;
  std::vector<cv::Point2d> ideal;
  const double K = r.gain_dn_per_e;
  const double floor_e2 = r.dark_noise_e * r.dark_noise_e + 1.0 / (12.0 * K * K);
  constexpr int kSteps = 100;
  for (int i = 0; i <= kSteps; ++i) {
    const double photons =
        first * std::pow(r.saturation_photons / first, static_cast<double>(i) / kSteps);
    const double electrons = r.quantum_efficiency * photons;
    model.emplace_back(photons, electrons / std::sqrt(electrons + floor_e2));
    ideal.emplace_back(photons, std::sqrt(photons));
  }
  plot.Line(ideal, plot_color::kGray, "ideal sensor");
  plot.Line(model, plot_color::kVermilion, "linear model with the measured figures");
  // Saturation takes the noise away: the ratio means nothing there.
  std::vector<cv::Point2d> points = Curve(r.points, signal_to_noise);
  points.resize(r.saturation_point + 1);
  plot.Points(points, plot_color::kBlue, "pairs of frames");
  plot.VerticalMark(r.saturation_photons, "saturation");
}

void DrawLinearity(cv::Mat3b& canvas, const Results& r) {
  const double full = r.points[r.saturation_point].signal();
  const double most =
      100.0 * std::max({0.002, 1.6 * r.linearity_error_max, -1.6 * r.linearity_error_min});
  Plot plot(canvas,
            {.area = PanelAt(1, 1),
             .title = fmt::format("Deviation from the response's line: {:+.2f} to {:+.2f} %",
                                  100.0 * r.linearity_error_min, 100.0 * r.linearity_error_max),
             .x = {"signal above dark [DN]", 0.0, 1.1 * full},
             .y = {"deviation [%]", -most, most}});
  const std::vector<cv::Point2d> zero = {{0.0, 0.0}, {1.1 * full, 0.0}};
  plot.Line(zero, plot_color::kGray, "", 1);
  plot.Points(Curve(r.points,
                    [&](const TransferPoint& p) {
                      const double line = r.responsivity * p.photons;
                      return cv::Point2d(p.signal(), 100.0 * (p.signal() / line - 1.0));
                    }),
              plot_color::kBlue, "from R");
  plot.VerticalMark(full, "saturation");
}

}  // namespace

cv::Mat3b PhotonTransferPicture(const Results& results) {
  cv::Mat3b canvas = WhiteCanvas({2 * kPanel.width, 2 * kPanel.height});
  DrawTransfer(canvas, results);
  DrawSensitivity(canvas, results);
  DrawSignalToNoise(canvas, results);
  DrawLinearity(canvas, results);
  return canvas;
}

}  // namespace fenestra::emva
