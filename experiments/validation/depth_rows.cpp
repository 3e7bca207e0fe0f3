#include "experiments/validation/validation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/depth_curves/depth_curves.h"
#include "experiments/statistics/moments.h"

namespace fenestra::validation {
namespace {

constexpr int kLeastBlocks = 8;    // Of a plane whose noise is judged.
constexpr int kLeastPixels = 500;  // Of a bin that is judged.

struct Compared {
  RecordedPlane plane;
  PlaneComparison figures;

  bool HasNoise() const {
    return figures.recorded.blocks >= kLeastBlocks && figures.simulated.blocks >= kLeastBlocks;
  }
  Row NewRow(const std::string& phenomenon, Origin origin) const {
    return {.phenomenon = fmt::format("{}: {}", phenomenon, plane.name),
            .recording = fmt::format("{} ({})", plane.file, plane.source),
            .origin = origin};
  }
};

bool IsFloor(const RecordedPlane& plane) {
  return plane.name.find("floor") != std::string::npos;
}

// The relative scatter of recorded noise from wall to wall, units and paints together. Floors are
// left out: noise grows with incidence.
double ScatterOfNoise(const std::vector<Compared>& planes) {
  std::vector<double> logarithms;
  for (const Compared& c : planes) {
    if (!c.HasNoise() || IsFloor(c.plane)) continue;
    logarithms.push_back(std::log(c.figures.recorded.noise_steps.value));
  }
  return logarithms.size() < 2 ? 0.0 : StandardDeviation(logarithms);
}

Row NoiseRow(const Compared& c, double scatter) {
  Row row = c.NewRow("axial noise in blocks of 32 × 32 px", Origin::kPredicted);
  row.recorded = Text(c.figures.recorded.noise_steps, "step");
  row.simulated = Text(c.figures.simulated.noise_steps, "step");
  JudgeRatio(row, c.figures.recorded.noise_steps, c.figures.simulated.noise_steps, scatter);
  return row;
}

// Six lags, three along rows and three along columns.
std::vector<Estimated> Lags(const PlaneFigures& figures) {
  std::vector<Estimated> lags(figures.along_rows.begin(), figures.along_rows.end());
  lags.insert(lags.end(), figures.along_columns.begin(), figures.along_columns.end());
  return lags;
}

std::vector<double> ScatterOfLags(const std::vector<Compared>& planes) {
  std::vector<double> scatter;
  for (size_t lag = 0; lag < 6; ++lag) {
    std::vector<double> values;
    for (const Compared& c : planes) {
      if (c.HasNoise()) values.push_back(Lags(c.figures.recorded)[lag].value);
    }
    scatter.push_back(values.size() < 2 ? 0.0 : StandardDeviation(values));
  }
  return scatter;
}

std::string LagTexts(const std::vector<Estimated>& lags) {
  return fmt::format("rows {:.2f} {:.2f} {:.2f}, columns {:.2f} {:.2f} {:.2f}", lags[0].value,
                     lags[1].value, lags[2].value, lags[3].value, lags[4].value, lags[5].value);
}

Row CorrelationRow(const Compared& c, const std::vector<double>& scatter) {
  Row row = c.NewRow("correlation of noise at 1, 2, 3 px", Origin::kPredicted);
  const std::vector<Estimated> recorded = Lags(c.figures.recorded);
  const std::vector<Estimated> simulated = Lags(c.figures.simulated);
  row.recorded = LagTexts(recorded);
  row.simulated = LagTexts(simulated);
  constexpr double kOneOfSix95 = 2.64;  // Normal, two-sided, 5 % for six figures together.
  double worst = -1.0;
  for (size_t lag = 0; lag < 6; ++lag) {
    const double difference = simulated[lag].value - recorded[lag].value;
    const double bound =
        kOneOfSix95 * std::hypot(recorded[lag].error, simulated[lag].error, scatter[lag]);
    if (std::abs(difference) / bound <= worst) continue;
    worst = std::abs(difference) / bound;
    row.agreement = fmt::format("{:+.2f} ± {:.2f} where it is worst", difference, bound);
  }
  row.verdict = worst <= 1.0 ? Verdict::kHolds : Verdict::kMisfit;
  return row;
}

// No place was recorded twice, so that no scatter says how far shares may differ: 10 points.
Row ShareRow(const Compared& c) {
  constexpr double kPoints = 10.0;
  const bool fitted = c.plane.name == "freiburg2 floor" || c.plane.name == "freiburg2 floor beyond";
  Row row = c.NewRow("pixels with a return", fitted ? Origin::kFitted : Origin::kPredicted);
  int bins = 0;
  double worst = -1.0;
  std::vector<std::string> missed;
  for (const auto& [place, recorded] : c.figures.recorded.bins) {
    const auto simulated = c.figures.simulated.bins.find(place);
    if (recorded.pixels < kLeastPixels || simulated == c.figures.simulated.bins.end()) continue;
    ++bins;
    const double points = 100.0 * (simulated->second.Share() - recorded.Share());
    if (std::abs(points) > kPoints) {
      missed.push_back(fmt::format("{} m, {}°", place.first, place.second));
    }
    if (std::abs(points) <= worst) continue;
    worst = std::abs(points);
    row.recorded =
        fmt::format("{:.1f} % from {} m, {}°", 100.0 * recorded.Share(), place.first, place.second);
    row.simulated = fmt::format("{:.1f} %", 100.0 * simulated->second.Share());
  }
  if (bins == 0) {
    row.recorded = row.simulated = "—";
    row.agreement = fmt::format("no bin of {} pixels", kLeastPixels);
    return row;
  }
  row.agreement = fmt::format("{:.1f} points apart, the largest of {} bins (bound: {:g})", worst,
                              bins, kPoints);
  if (!missed.empty())
    row.agreement += fmt::format("; beyond it: from {}", fmt::join(missed, "; "));
  row.verdict = missed.empty() ? Verdict::kHolds : Verdict::kMisfit;
  return row;
}

// Where half of the pixels return, by bins of range alone.
double HalfLost(const std::vector<Compared>& planes, PlaneFigures PlaneComparison::*side) {
  std::map<double, PlaneFigures::Bin> by_range;
  for (const Compared& c : planes) {
    if (!c.plane.name.starts_with("freiburg2 floor")) continue;
    for (const auto& [place, bin] : (c.figures.*side).bins) {
      by_range[place.first].pixels += bin.pixels;
      by_range[place.first].valid += bin.valid;
    }
  }
  std::vector<cv::Point2d> curve;
  for (const auto& [least_m, bin] : by_range) {
    if (bin.pixels >= kLeastPixels) curve.emplace_back(least_m + 0.25, bin.Share());
  }
  return HalfPoint(curve);
}

Row HalfLostRow(const std::vector<Compared>& planes) {
  constexpr double kBin_m = 0.5;
  Row row{.phenomenon = "range at which half of a floor is lost: freiburg2",
          .recording = "rgbd-tum/second_depth.png (TUM RGB-D, CC BY 4.0)",
          .origin = Origin::kFitted};
  const double recorded_m = HalfLost(planes, &PlaneComparison::recorded);
  const double simulated_m = HalfLost(planes, &PlaneComparison::simulated);
  row.recorded = fmt::format("{:.2f} m", recorded_m);
  row.simulated = fmt::format("{:.2f} m", simulated_m);
  JudgeRange(row, simulated_m, recorded_m - 0.5 * kBin_m, recorded_m + 0.5 * kBin_m,
             "m: half a bin");
  return row;
}

// TUM's depths are scaled and do not count. The files of PCL agree to the last digit, since the
// driver's table makes their depths: they say nothing of how far units differ. The bound is what
// was found in further Kinects, of OpenNI's driver and libfreenect.
Row StepRow(const std::filesystem::path& recordings, const StructuredLightOptions& options) {
  Row row{.phenomenon = "step of depth over z², 1.5 to 4 m",
          .recording = "depth-pcl, all files (PointCloudLibrary, BSD-3)",
          .origin = Origin::kDesign};
  std::set<std::string> files;
  std::vector<double> steps;
  for (const RecordedPlane& plane : RecordedPlanes()) {
    if (!plane.file.starts_with("depth-pcl") || !files.insert(plane.file).second) continue;
    const double step = StepOfDepths(ViewOf(plane, recordings));
    if (!std::isnan(step)) steps.push_back(1e3 * step);
  }
  const RecordedPlane& floor = RecordedPlanes()[6];
  const DepthView real = ViewOf(floor, recordings);
  const double simulated = 1e3 * StepOfDepths(Simulate(StructuredLightSensor(options),
                                                       FitPlane(real, MaskIn(floor, real))));
  row.recorded = fmt::format("{:.3f}e-3/m, alike in {} files; 2.86e-3 to 2.94e-3/m in further ones",
                             Mean(steps), steps.size());
  row.simulated = fmt::format("{:.3f}e-3/m", simulated);
  JudgeRange(row, simulated, 2.86, 2.94, "e-3/m");
  return row;
}

// Units differ: the scatter is that of the recorded planes themselves.
std::vector<Row> SmoothRows(const std::vector<Compared>& planes,
                            const std::filesystem::path& recordings,
                            const StructuredLightOptions& options) {
  std::vector<Row> rows;
  std::vector<SmoothErrors> errors;
  std::vector<double> logarithms;
  for (const Compared& c : planes) {
    if (!c.HasNoise()) continue;
    errors.push_back(CompareSmoothErrors(c.plane, recordings,
                                         UnitDeviations::Calibrated().disparity_warp_px, options));
    logarithms.push_back(std::log(errors.back().recorded));
    rows.push_back(c.NewRow("smooth error beside a plane", Origin::kFitted));
  }
  const double tau = logarithms.size() < 2 ? 0.0 : StandardDeviation(logarithms);
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].recorded = fmt::format("{:.2f} step", errors[i].recorded);
    rows[i].simulated = fmt::format("{:.2f} step, RMS of four units", errors[i].simulated);
    JudgeRatio(rows[i], {errors[i].recorded, 0.0}, {errors[i].simulated, 0.0}, tau);
  }
  return rows;
}

}  // namespace

std::vector<Row> DepthRows(const std::filesystem::path& recordings,
                           const StructuredLightOptions& options) {
  std::vector<Compared> planes;
  for (const RecordedPlane& plane : RecordedPlanes()) {
    planes.push_back({plane, Compare(plane, recordings, options)});
  }
  std::vector<Row> rows = {StepRow(recordings, options)};
  const double scatter = ScatterOfNoise(planes);
  for (const Compared& c : planes) {
    if (c.HasNoise()) rows.push_back(NoiseRow(c, scatter));
  }
  const std::vector<double> of_lags = ScatterOfLags(planes);
  for (const Compared& c : planes) {
    if (c.HasNoise()) rows.push_back(CorrelationRow(c, of_lags));
  }
  for (const Compared& c : planes) rows.push_back(ShareRow(c));
  rows.push_back(HalfLostRow(planes));
  for (Row& row : SmoothRows(planes, recordings, options)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace fenestra::validation
