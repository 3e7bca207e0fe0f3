#include "vision/calibration/stereo_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/input_error.h"
#include "vision/calibration/initial_pair.h"

namespace fenestra {
namespace {

constexpr size_t kFewestShared = 6;
constexpr size_t kFewestViews = 3;
constexpr double kLargestFocalDeviation = 0.05;

std::vector<CornerResidual> ResidualsOf(const CameraModel& camera, const Pose& X_CG,
                                        const std::vector<BoardCorner>& corners,
                                        const CalibrationBoard& board) {
  std::vector<CornerResidual> residuals;
  for (const BoardCorner& corner : corners) {
    const auto projected = camera.Project(X_CG * board.Corner(corner.id));
    if (projected) residuals.push_back({corner.pixel, corner.pixel - *projected});
  }
  return residuals;
}

double SquaredResiduals(const CameraModel& camera, const Pose& X_CG,
                        const std::vector<BoardCorner>& corners, const CalibrationBoard& board) {
  double sum = 0.0;
  for (const CornerResidual& r : ResidualsOf(camera, X_CG, corners, board)) {
    sum += r.residual_px.squaredNorm();
  }
  return sum;
}

// Weights each image by its own residuals. Because of blur, tilt and light, the accuracy of corners
// differs between images by up to a factor of three, and a covariance that ignores this is wrong.
// All images contribute equally to the degrees of freedom that are subtracted.
void Weigh(const AdjustedPair& pair, const CalibrationBoard& board, std::vector<BoardView>& views) {
  const double freedom = 1.0 - static_cast<double>(pair.unknown_count) / pair.residual_count;
  const double usual = pair.variance();
  const auto weight = [&](double squared_residuals, size_t corners) {
    // Acts like ten additional residuals of typical size, so that no image gets an unlimited
    // weight.
    constexpr double kPrior = 10.0;
    const double count = 2.0 * static_cast<double>(corners) * freedom;
    return usual * (count + kPrior) / (squared_residuals + kPrior * usual);
  };
  const StereoCalibration& cameras = pair.state.cameras;
  for (size_t i = 0; i < views.size(); ++i) {
    const Pose& X_LG = pair.state.X_LG[i];
    BoardView& view = views[i];
    view.left_weight =
        weight(SquaredResiduals(cameras.left, X_LG, view.left, board), view.left.size());
    view.right_weight = weight(
        SquaredResiduals(cameras.right, cameras.X_RL * X_LG, view.right, board), view.right.size());
  }
}

AdjustedPair Calibrate(const std::vector<NamedView>& views, const CalibrationBoard& board,
                       const StereoCalibratorOptions& options) {
  std::vector<BoardView> corners;
  for (const NamedView& view : views) corners.push_back(view.corners);
  const PairState start =
      InitialPair(corners, board, {options.left_size, options.right_size}, options.adjustment);
  AdjustedPair unweighted = AdjustPair(start, corners, board, options.adjustment);
  if (!(unweighted.variance() > 0.0)) return unweighted;  // Corners without noise.
  Weigh(unweighted, board, corners);
  return AdjustPair(unweighted.state, corners, board, options.adjustment);
}

double Rms(const std::vector<CornerResidual>& residuals) {
  double sum = 0.0;
  for (const CornerResidual& r : residuals) sum += r.residual_px.squaredNorm();
  return residuals.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(residuals.size()));
}

StereoCalibrationResult ResultOf(const AdjustedPair& pair, const std::vector<NamedView>& views,
                                 const CalibrationBoard& board) {
  StereoCalibrationResult result{
      .calibration = pair.state.cameras,
      .covariance = pair.covariance(),
      .corner_deviation_px = std::sqrt(pair.variance()),
      .rms_px = std::sqrt(2.0 * pair.squared_residuals / pair.residual_count),
      .camera_rms_px = {},
      .views = {},
      .residuals = {},
      .left_out = {}};
  const StereoCalibration& cameras = result.calibration;
  for (size_t i = 0; i < views.size(); ++i) {
    const Pose& X_LG = pair.state.X_LG[i];
    const std::array<std::vector<CornerResidual>, 2> of_view = {
        ResidualsOf(cameras.left, X_LG, views[i].corners.left, board),
        ResidualsOf(cameras.right, cameras.X_RL * X_LG, views[i].corners.right, board)};
    result.views.push_back({views[i].name, Rms(of_view[0]), Rms(of_view[1])});
    for (size_t c = 0; c < 2; ++c) {
      result.residuals[c].insert(result.residuals[c].end(), of_view[c].begin(), of_view[c].end());
    }
  }
  result.camera_rms_px = {Rms(result.residuals[0]), Rms(result.residuals[1])};
  std::vector<CornerResidual> all = result.residuals[0];
  all.insert(all.end(), result.residuals[1].begin(), result.residuals[1].end());
  result.rms_px = Rms(all);
  result.corner_deviation_px =
      result.rms_px *
      std::sqrt(0.5 * pair.residual_count / (pair.residual_count - pair.unknown_count));
  return result;
}

double Worse(const ViewResiduals& view) {
  return std::max(view.left_rms_px, view.right_rms_px);
}

double MedianRms(const std::vector<ViewResiduals>& views) {
  std::vector<double> rms;
  for (const ViewResiduals& view : views) rms.push_back(Worse(view));
  std::nth_element(rms.begin(), rms.begin() + static_cast<std::ptrdiff_t>(rms.size() / 2),
                   rms.end());
  return rms[rms.size() / 2];
}

// Moves the views that see too little from `views` to the result.
std::vector<LeftOutView> TakeOutPoorViews(std::vector<NamedView>& views,
                                          const CalibrationBoard& board) {
  std::vector<LeftOutView> left_out;
  std::erase_if(views, [&](const NamedView& view) {
    const size_t shared = CountShared(view.corners, board);
    if (shared >= kFewestShared) return false;
    left_out.push_back({view.name, fmt::format("{} corners are seen by both cameras, {} are needed",
                                               shared, kFewestShared)});
    return true;
  });
  return left_out;
}

void CheckCount(const std::vector<NamedView>& views) {
  if (views.size() >= kFewestViews) return;
  throw InputError("calibration",
                   fmt::format("the board is seen by both cameras in {} view{}; {} are the least, "
                               "10 to 20 are usual",
                               views.size(), views.size() == 1 ? "" : "s", kFewestViews));
}

void CheckFocalLengths(const StereoCalibrationResult& result) {
  for (const int place : {0, kCameraParameters}) {
    const CameraModel& camera = place == 0 ? result.calibration.left : result.calibration.right;
    const double deviation = std::sqrt(result.covariance(place, place));
    const double focal_px = camera.parameters().fx_px;
    if (deviation <= kLargestFocalDeviation * focal_px) continue;
    throw InputError(
        "calibration",
        fmt::format("the views do not determine the {} camera's focal length ({:.0f} ± {:.0f} px): "
                    "the board has to be tilted in different directions, near and far",
                    place == 0 ? "left" : "right", focal_px, deviation));
  }
}

}  // namespace

const std::array<std::string, kPairParameters>& PairParameterNames() {
  static const std::array<std::string, kPairParameters> names = [] {
    const std::array<const char*, kCameraParameters> of_camera = {
        "fx [px]", "fy [px]", "cx [px]", "cy [px]", "k1", "k2", "p1", "p2", "k3"};
    std::array<std::string, kPairParameters> all;
    for (size_t i = 0; i < of_camera.size(); ++i) {
      all[i] = fmt::format("left {}", of_camera[i]);
      all[of_camera.size() + i] = fmt::format("right {}", of_camera[i]);
    }
    const std::array<const char*, 6> relative = {"rotation x [rad]",  "rotation y [rad]",
                                                 "rotation z [rad]",  "translation x [m]",
                                                 "translation y [m]", "translation z [m]"};
    std::copy(relative.begin(), relative.end(), all.end() - 6);
    return all;
  }();
  return names;
}

StereoCalibrationResult CalibrateStereo(const std::vector<NamedView>& views,
                                        const CalibrationBoard& board,
                                        const StereoCalibratorOptions& options) {
  Validate(board);
  std::vector<NamedView> used = views;
  std::vector<LeftOutView> left_out = TakeOutPoorViews(used, board);
  CheckCount(used);
  StereoCalibrationResult result = ResultOf(Calibrate(used, board, options), used, board);
  const double most_px = options.outlier_factor * MedianRms(result.views);
  std::vector<NamedView> inliers;
  for (size_t i = 0; i < used.size(); ++i) {
    if (Worse(result.views[i]) <= most_px) {
      inliers.push_back(used[i]);
      continue;
    }
    left_out.push_back(
        {used[i].name, fmt::format("residuals of {:.2f} px RMS are more than {:g} times the usual",
                                   Worse(result.views[i]), options.outlier_factor)});
  }
  if (inliers.size() < used.size()) {
    CheckCount(inliers);
    result = ResultOf(Calibrate(inliers, board, options), inliers, board);
  }
  CheckFocalLengths(result);
  result.left_out = std::move(left_out);
  return result;
}

}  // namespace fenestra
