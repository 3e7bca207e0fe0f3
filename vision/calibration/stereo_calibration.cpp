#include "vision/calibration/stereo_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/calib3d.hpp>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

constexpr size_t kFewestShared = 6;
constexpr size_t kFewestViews = 3;
constexpr double kLargestFocalDeviation = 0.05;

// Corners on the board and in the image, as OpenCV expects them.
struct PointPairs {
  std::vector<cv::Point3f> on_board;
  std::vector<cv::Point2f> in_image;
};

cv::Point3f OnBoard(const CalibrationBoard& board, int id) {
  const Eigen::Vector3d p_GQ = board.Corner(id);
  return {static_cast<float>(p_GQ.x()), static_cast<float>(p_GQ.y()), 0.0f};
}

cv::Point2f InImage(const BoardCorner& corner) {
  return {static_cast<float>(corner.pixel.x()), static_cast<float>(corner.pixel.y())};
}

PointPairs PairsOf(const std::vector<BoardCorner>& corners, const CalibrationBoard& board) {
  PointPairs pairs;
  for (const BoardCorner& corner : corners) {
    pairs.on_board.push_back(OnBoard(board, corner.id));
    pairs.in_image.push_back(InImage(corner));
  }
  return pairs;
}

// Result of cv::calibrateCamera for one camera.
struct SingleCamera {
  cv::Matx33d matrix;
  cv::Mat distortion;
  std::vector<Pose> X_CG;
};

Pose PoseOf(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  const cv::Vec3d r(rotation_vector);
  const cv::Vec3d t(translation);
  return Pose(RotationFromVector({r[0], r[1], r[2]}), {t[0], t[1], t[2]});
}

template <typename CornersOf>
SingleCamera CalibrateSingle(const std::vector<NamedView>& views, const CalibrationBoard& board,
                             cv::Size size, const AdjustmentOptions& options,
                             CornersOf corners_of) {
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> in_image;
  for (const NamedView& view : views) {
    PointPairs pairs = PairsOf(corners_of(view), board);
    on_board.push_back(std::move(pairs.on_board));
    in_image.push_back(std::move(pairs.in_image));
  }
  SingleCamera camera;
  cv::Mat matrix;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  const int flags = options.free_k3 ? 0 : cv::CALIB_FIX_K3;
  cv::calibrateCamera(on_board, in_image, size, matrix, camera.distortion, rotations, translations,
                      flags);
  camera.matrix = matrix;
  for (size_t i = 0; i < rotations.size(); ++i) {
    camera.X_CG.push_back(PoseOf(rotations[i], translations[i]));
  }
  return camera;
}

CameraModel ModelOf(const SingleCamera& camera, cv::Size size) {
  const auto d = [&](int i) { return camera.distortion.at<double>(i); };
  return CameraModel({.width_px = size.width,
                      .height_px = size.height,
                      .fx_px = camera.matrix(0, 0),
                      .fy_px = camera.matrix(1, 1),
                      .cx_px = camera.matrix(0, 2),
                      .cy_px = camera.matrix(1, 2),
                      .distortion = {.k1 = d(0), .k2 = d(1), .p1 = d(2), .p2 = d(3), .k3 = d(4)}});
}

// The corners of a view that both cameras saw.
struct SharedCorners {
  std::vector<cv::Point3f> on_board;
  std::vector<cv::Point2f> left;
  std::vector<cv::Point2f> right;
};

SharedCorners SharedBy(const BoardView& view, const CalibrationBoard& board) {
  std::map<int, cv::Point2f> right;
  for (const BoardCorner& corner : view.right) right[corner.id] = InImage(corner);
  SharedCorners shared;
  for (const BoardCorner& corner : view.left) {
    const auto match = right.find(corner.id);
    if (match == right.end()) continue;
    shared.on_board.push_back(OnBoard(board, corner.id));
    shared.left.push_back(InImage(corner));
    shared.right.push_back(match->second);
  }
  return shared;
}

Pose RelativePose(const std::vector<NamedView>& views, const CalibrationBoard& board,
                  const SingleCamera& left, const SingleCamera& right, cv::Size size) {
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> in_left;
  std::vector<std::vector<cv::Point2f>> in_right;
  for (const NamedView& view : views) {
    SharedCorners shared = SharedBy(view.corners, board);
    on_board.push_back(std::move(shared.on_board));
    in_left.push_back(std::move(shared.left));
    in_right.push_back(std::move(shared.right));
  }
  cv::Mat left_matrix(left.matrix);
  cv::Mat right_matrix(right.matrix);
  cv::Mat left_distortion = left.distortion.clone();
  cv::Mat right_distortion = right.distortion.clone();
  cv::Mat R;
  cv::Mat T;
  cv::Mat essential;
  cv::Mat fundamental;
  cv::stereoCalibrate(on_board, in_left, in_right, left_matrix, left_distortion, right_matrix,
                      right_distortion, size, R, T, essential, fundamental,
                      cv::CALIB_FIX_INTRINSIC);
  cv::Mat rotation_vector;
  cv::Rodrigues(R, rotation_vector);
  return PoseOf(rotation_vector, T);
}

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
  const SingleCamera left = CalibrateSingle(
      views, board, options.left_size, options.adjustment,
      [](const NamedView& view) -> const auto& { return view.corners.left; });
  const SingleCamera right = CalibrateSingle(
      views, board, options.right_size, options.adjustment,
      [](const NamedView& view) -> const auto& { return view.corners.right; });
  const PairState start{
      .cameras = {.left = ModelOf(left, options.left_size),
                  .right = ModelOf(right, options.right_size),
                  .X_RL = RelativePose(views, board, left, right, options.left_size)},
      .X_LG = left.X_CG};
  std::vector<BoardView> corners;
  for (const NamedView& view : views) corners.push_back(view.corners);
  const AdjustedPair unweighted = AdjustPair(start, corners, board, options.adjustment);
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
    const size_t shared = SharedBy(view.corners, board).on_board.size();
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
