#include "vision/calibration/initial_pair.h"

#include <map>
#include <opencv2/calib3d.hpp>
#include <utility>

namespace fenestra {
namespace {

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

SingleCamera CalibrateSingle(const std::vector<BoardView>& views,
                             std::vector<BoardCorner> BoardView::*corners,
                             const CalibrationBoard& board, cv::Size size,
                             const AdjustmentOptions& options) {
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> in_image;
  for (const BoardView& view : views) {
    PointPairs pairs = PairsOf(view.*corners, board);
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

Pose RelativePose(const std::vector<BoardView>& views, const CalibrationBoard& board,
                  const SingleCamera& left, const SingleCamera& right, cv::Size size) {
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> in_left;
  std::vector<std::vector<cv::Point2f>> in_right;
  for (const BoardView& view : views) {
    SharedCorners shared = SharedBy(view, board);
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

}  // namespace

size_t CountShared(const BoardView& view, const CalibrationBoard& board) {
  return SharedBy(view, board).on_board.size();
}

PairState InitialPair(const std::vector<BoardView>& views, const CalibrationBoard& board,
                      const PairSizes& sizes, const AdjustmentOptions& options) {
  const SingleCamera left = CalibrateSingle(views, &BoardView::left, board, sizes.left, options);
  const SingleCamera right = CalibrateSingle(views, &BoardView::right, board, sizes.right, options);
  return {.cameras = {.left = ModelOf(left, sizes.left),
                      .right = ModelOf(right, sizes.right),
                      .X_RL = RelativePose(views, board, left, right, sizes.left)},
          .X_LG = left.X_CG};
}

}  // namespace fenestra
