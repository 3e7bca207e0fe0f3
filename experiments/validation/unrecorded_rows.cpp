#include "experiments/validation/validation.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/geometry/pose.h"
#include "experiments/depth_curves/depth_curves.h"
#include "experiments/depth_curves/depth_laws.h"
#include "experiments/depth_curves/wall_setup.h"
#include "experiments/validation/simulated_planes.h"

namespace fenestra::validation {
namespace {

constexpr char kNoRecording[] = "none";
constexpr char kNoFile[] = "Kinects, whose recordings may not be handed on: figures without a file";
const RandomStream kStream(1);

Row NotJudged(const std::string& phenomenon, Origin origin, const std::string& simulated,
              const std::string& why) {
  return {.phenomenon = phenomenon,
          .recording = kNoRecording,
          .recorded = "—",
          .simulated = simulated,
          .origin = origin,
          .agreement = why};
}

std::vector<Row> PaintRows(const StructuredLightOptions& options) {
  constexpr double kBlackPaint = 0.05;
  const WallSetup black(options, kBlackPaint, {}, kStream);
  std::string facing;
  for (const double z_m : {2.5, 3.0, 3.5, 4.0, 4.5}) {
    facing += fmt::format("{}{:.0f} % at {} m", facing.empty() ? "" : ", ",
                          100.0 * ValidShare(black.See({.distance_m = z_m})), z_m);
  }
  std::string turned;
  for (const double angle_deg : {10.0, 20.0, 35.0}) {
    const Viewpoint from{.distance_m = 3.5, .azimuth_rad = angle_deg * kDegree};
    turned += fmt::format("{}{:.0f} % at {}°", turned.empty() ? "" : ", ",
                          100.0 * ValidShare(black.See(from)), angle_deg);
  }
  const std::string why = "no paint measured at 830 nm";
  return {
      NotJudged("black paint (5 %), facing: pixels with a return", Origin::kPredicted, facing, why),
      NotJudged("black paint (5 %) at 3.5 m, turned: pixels with a return", Origin::kPredicted,
                turned, why)};
}

// The flickering part of the speckle was chosen so that this lies in the recorded band.
std::vector<Row> TemporalRows(const StructuredLightOptions& options) {
  std::vector<Row> rows;
  const WallSetup white(options, WallSetup::kWhite, {}, kStream);
  for (const double z_m : {1.0, 2.0, 3.0, 4.0}) {
    const double steps = white.TemporalNoise({.distance_m = z_m, .azimuth_rad = kDegree}) /
                         (kStepOfOpenNi * z_m * z_m);
    Row row{.phenomenon = fmt::format("noise in time at {} m", z_m),
            .recording = kNoFile,
            .recorded = "0.2 to 0.5 step",
            .simulated = fmt::format("{:.2f} step", steps),
            .origin = Origin::kFitted};
    JudgeRange(row, steps, 0.2, 0.5, "step");
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> BorderRows(const StructuredLightOptions& options) {
  std::vector<Row> rows;
  for (const DepthCurves::Lateral& border : MeasureLateral(options, kStream)) {
    const double angle_deg = border.angle_rad / kDegree;
    if (angle_deg > 20.5) break;  // The recorded ones face the sensor, more or less.
    const auto add = [&](const char* side, double found_px, double low_px, double high_px) {
      Row row{.phenomenon = fmt::format("roughness of upright borders, {} of a plate at {:.0f}°",
                                        side, angle_deg),
              .recording = kNoFile,
              .recorded = fmt::format("{} to {} px of 640", low_px, high_px),
              .simulated = fmt::format("{:.2f} px", found_px),
              .origin = Origin::kPredicted};
      JudgeRange(row, found_px, low_px, high_px, "px");
      rows.push_back(std::move(row));
    };
    add("left", border.left_px, 1.0, 1.6);
    add("right", border.right_px, 0.7, 0.8);
  }
  return rows;
}

// Columns from the right border on that nowhere have a return.
int EmptyColumns(const cv::Mat1w& raw) {
  int empty = 0;
  while (empty < raw.cols && cv::countNonZero(raw.col(raw.cols - 1 - empty)) == 0) ++empty;
  return empty;
}

Row EmptyColumnsRow(const StructuredLightOptions& options) {
  const WallSetup white(options, WallSetup::kWhite, {}, kStream);
  const int empty = EmptyColumns(white.See({.distance_m = 2.0}).raw);
  Row row{.phenomenon = "empty columns on the right of 640, not registered",
          .recording = kNoFile,
          .recorded = "8 columns",
          .simulated = fmt::format("{} columns", empty),
          .origin = Origin::kDesign};
  JudgeRange(row, empty, 8.0, 8.0, "columns");
  return row;
}

Row DaylightRow(const StructuredLightOptions& options) {
  std::string limits;
  for (const double z_m : {2.0, 3.0}) {
    limits += fmt::format("{}{:.0f} klx at {} m", limits.empty() ? "" : ", ",
                          1e-3 * PredictedAmbientLimit(options, WallSetup::kWhite, z_m), z_m);
  }
  return NotJudged("daylight in which half of a white wall is lost, upper limit", Origin::kAssumed,
                   limits, "an assumption without a recording");
}

}  // namespace

std::vector<Row> UnrecordedDepthRows(const StructuredLightOptions& options) {
  std::vector<Row> rows = PaintRows(options);
  const auto append = [&rows](std::vector<Row> more) {
    std::move(more.begin(), more.end(), std::back_inserter(rows));
  };
  append(TemporalRows(options));
  append(BorderRows(options));
  append({EmptyColumnsRow(options), DaylightRow(options)});
  return rows;
}

}  // namespace fenestra::validation
