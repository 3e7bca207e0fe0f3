#include "experiments/rig_calibration/calibration_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "core/geometry/calibration.h"
#include "core/io/image_io.h"
#include "core/io/temporary_files.h"
#include "experiments/output/file_formats.h"
#include "experiments/output/number_format.h"
#include "experiments/output/plot.h"
#include "experiments/output/text_table.h"

namespace fenestra {
namespace {

std::string Text(const TextTable& table, ReportFormat format) {
  return format == ReportFormat::kMarkdown ? table.ToMarkdown() : table.ToPlainText();
}

std::string Heading(const std::string& text, ReportFormat format) {
  return format == ReportFormat::kMarkdown ? "\n## " + text + "\n\n" : "\n" + text + "\n";
}

// Distortions have deviations far below 0.001.
std::string WithDeviation(double value, double deviation) {
  if (!(deviation > 0.0)) return fmt::format("{:g} (fixed)", value);
  return WithStandardError(value, deviation, 9);
}

PairVector ValuesOf(const StereoCalibration& calibration) {
  // Read from an identity rotation, the error's rotation part is the rotation vector itself.
  const StereoCalibration zero{
      .left = calibration.left, .right = calibration.right, .X_RL = Pose()};
  PairVector values = PairError(zero, calibration);
  values.head<kCameraParameters>() = calibration.left.ParameterVector();
  values.segment<kCameraParameters>(kCameraParameters) = calibration.right.ParameterVector();
  return values;
}

TextTable CameraTable(const StereoCalibrationResult& result) {
  TextTable table;
  table.AddColumn("parameter", TextTable::Align::kLeft);
  table.AddColumn("left");
  table.AddColumn("right");
  const PairVector values = ValuesOf(result.calibration);
  for (int i = 0; i < kCameraParameters; ++i) {
    const auto shown = [&](int place) {
      return WithDeviation(values[place], std::sqrt(result.covariance(place, place)));
    };
    const std::string name = PairParameterNames()[static_cast<size_t>(i)];
    table.AddRow({name.substr(name.find(' ') + 1), shown(i), shown(kCameraParameters + i)});
  }
  return table;
}

TextTable PoseTable(const StereoCalibrationResult& result) {
  TextTable table;
  table.AddColumn("left to right camera", TextTable::Align::kLeft);
  table.AddColumn("rotation [mrad]");
  table.AddColumn("translation [mm]");
  const PairVector values = ValuesOf(result.calibration);
  const std::array<const char*, 3> axes = {"x (right)", "y (down)", "z (forward)"};
  for (int i = 0; i < 3; ++i) {
    const auto shown = [&](int place) {
      return WithDeviation(1e3 * values[place], 1e3 * std::sqrt(result.covariance(place, place)));
    };
    table.AddRow({axes[static_cast<size_t>(i)], shown(2 * kCameraParameters + i),
                  shown(2 * kCameraParameters + 3 + i)});
  }
  return table;
}

TextTable ViewTable(const StereoCalibrationResult& result) {
  TextTable table;
  table.AddColumn("view", TextTable::Align::kLeft);
  table.AddColumn("left RMS [px]");
  table.AddColumn("right RMS [px]");
  for (const ViewResiduals& view : result.views) {
    table.AddRow({view.name, fmt::format("{:.3f}", view.left_rms_px),
                  fmt::format("{:.3f}", view.right_rms_px)});
  }
  return table;
}

// The pairs of parameters that the views tell apart worst.
TextTable CorrelationTable(const StereoCalibrationResult& result) {
  struct Entry {
    int a;
    int b;
    double correlation;
  };
  std::vector<Entry> entries;
  for (int a = 0; a < kPairParameters; ++a) {
    for (int b = a + 1; b < kPairParameters; ++b) {
      const double scale = std::sqrt(result.covariance(a, a) * result.covariance(b, b));
      if (scale > 0.0) entries.push_back({a, b, result.covariance(a, b) / scale});
    }
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& x, const Entry& y) {
    return std::abs(x.correlation) > std::abs(y.correlation);
  });
  TextTable table;
  table.AddColumn("parameters", TextTable::Align::kLeft);
  table.AddColumn("", TextTable::Align::kLeft);
  table.AddColumn("correlation");
  constexpr size_t kShown = 6;
  for (size_t i = 0; i < std::min(kShown, entries.size()); ++i) {
    table.AddRow({PairParameterNames()[static_cast<size_t>(entries[i].a)],
                  PairParameterNames()[static_cast<size_t>(entries[i].b)],
                  fmt::format("{:+.3f}", entries[i].correlation)});
  }
  return table;
}

std::string BoardText(const CalibrationBoard& board) {
  const std::string kind = board.kind == BoardKind::kCharuco
                               ? fmt::format("ChArUco, markers of {:g} mm", 1e3 * board.marker_m)
                               : "chessboard";
  return fmt::format("{} x {} inner corners, squares of {:g} mm, {}", board.corner_columns(),
                     board.corner_rows(), 1e3 * board.square_m, kind);
}

// The rotations to parallel rows and the projections after them, which stereo matching needs.
std::array<RosRectification, 2> RectificationOf(const StereoCalibration& calibration) {
  const auto matrix = [](const CameraModel& camera) {
    cv::Mat K;
    cv::eigen2cv(camera.Matrix(), K);
    return K;
  };
  const auto distortion = [](const CameraModel& camera) {
    const BrownConrady& d = camera.parameters().distortion;
    return cv::Vec<double, 5>(d.k1, d.k2, d.p1, d.p2, d.k3);
  };
  cv::Mat R;
  cv::Mat T;
  cv::eigen2cv(calibration.X_RL.rotation(), R);
  cv::eigen2cv(calibration.X_RL.translation(), T);
  std::array<cv::Mat, 2> rotation;
  std::array<cv::Mat, 2> projection;
  cv::Mat Q;
  cv::stereoRectify(matrix(calibration.left), distortion(calibration.left),
                    matrix(calibration.right), distortion(calibration.right),
                    {calibration.left.width_px(), calibration.left.height_px()}, R, T, rotation[0],
                    rotation[1], projection[0], projection[1], Q, cv::CALIB_ZERO_DISPARITY, 0.0);
  std::array<RosRectification, 2> result;
  for (size_t i = 0; i < 2; ++i) {
    cv::cv2eigen(rotation[i], result[i].rotation);
    cv::cv2eigen(projection[i], result[i].projection);
  }
  return result;
}

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

std::string CalibrationReport(const StereoCalibrationResult& result, const CalibrationBoard& board,
                              ReportFormat format) {
  std::string text = format == ReportFormat::kMarkdown ? "# Stereo calibration\n\n" : "";
  text += fmt::format("{} views of a board of {}\n", result.views.size(), BoardText(board));
  text += fmt::format(
      "RMS {:.3f} px (left {:.3f}, right {:.3f}); a corner's coordinate is uncertain by {:.3f} "
      "px\n",
      result.rms_px, result.camera_rms_px[0], result.camera_rms_px[1], result.corner_deviation_px);
  text += fmt::format("baseline {:.2f} mm\n", 1e3 * result.calibration.X_RL.translation().norm());
  text += Heading("Cameras (± one standard deviation)", format) + Text(CameraTable(result), format);
  text += Heading("Between the cameras", format) + Text(PoseTable(result), format);
  text += Heading("Views", format) + Text(ViewTable(result), format);
  if (!result.left_out.empty()) {
    text += Heading("Left out", format);
    const char* bullet = format == ReportFormat::kMarkdown ? "* " : "";
    for (const LeftOutView& view : result.left_out) {
      text += fmt::format("{}{}: {}\n", bullet, view.name, view.reason);
    }
  }
  if (format == ReportFormat::kMarkdown) {
    text += Heading("What the views tell apart worst", format);
    text += Text(CorrelationTable(result), format);
    text += "\nAll covariances: covariance.csv. Residuals: residuals.png.\n";
  }
  return text;
}

std::string CovarianceCsv(const StereoCalibrationResult& result) {
  CsvWriter csv;
  csv.Add("parameter");
  for (const std::string& name : PairParameterNames()) csv.Add(name);
  csv.EndLine();
  for (int row = 0; row < kPairParameters; ++row) {
    csv.Add(PairParameterNames()[static_cast<size_t>(row)]);
    for (int column = 0; column < kPairParameters; ++column)
      csv.Add(result.covariance(row, column));
    csv.EndLine();
  }
  return csv.text();
}

void WriteCalibration(const OutputPath& folder, const StereoCalibrationResult& result,
                      const CalibrationBoard& board) {
  const std::array<RosRectification, 2> rectification = RectificationOf(result.calibration);
  WriteFileAtomically(folder / "stereo.yaml", ToOpenCvYaml(result.calibration));
  WriteFileAtomically(folder / "left.yaml",
                      ToRosCameraInfo(result.calibration.left, "left", rectification[0]));
  WriteFileAtomically(folder / "right.yaml",
                      ToRosCameraInfo(result.calibration.right, "right", rectification[1]));
  WriteFileAtomically(folder / "report.md",
                      CalibrationReport(result, board, ReportFormat::kMarkdown));
  WriteFileAtomically(folder / "covariance.csv", CovarianceCsv(result));
  WritePng(folder / "residuals.png", ResidualPicture(result));
}

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
