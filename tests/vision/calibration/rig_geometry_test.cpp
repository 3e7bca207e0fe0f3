// Geometry as finished pictures show it: nothing here asks the rig for its cameras, other than to
// compare with. Boards stand at known places before rigs of known poses; noise is off.

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <array>

#include "scenes/targets/flat_targets.h"
#include "sim/motion/rig_pose.h"
#include "sim/stereo/stereo_rig.h"
#include "vision/calibration/board_finder.h"

namespace fenestra {
namespace {

StereoRigOptions Noiseless(double focal_length_m) {
  StereoRigOptions options;
  options.focal_length_m = focal_length_m;
  options.distortion = {};
  options.sensor.noise = false;
  options.sensor.fixed_pattern = false;
  options.as_designed = true;
  return options;
}

// A board as wide as this share of the image of both cameras, at this distance.
CalibrationBoard BoardFor(const StereoRigOptions& options, double distance_m, double share) {
  CalibrationBoard board;
  const double view_m =
      distance_m * options.width_px * options.pixel_pitch_m / options.focal_length_m;
  board.square_m = share * (view_m - options.baseline_m) / board.columns;
  return board;
}

// Corners of the same board in both pictures, and where they are in the rig's frame B.
struct SeenBoard {
  std::vector<Eigen::Vector3d> p_B;
  std::array<std::vector<Eigen::Vector2d>, 2> pixels;
};

SeenBoard See(const StereoRig& rig, const CalibrationBoard& board, const Viewpoint& viewpoint) {
  const RayCaster caster(MakeBoardScene({.board = board}));
  const Pose X_WB = RigPose(viewpoint, Pose());
  Lighting lighting;
  lighting.sky.illuminance_lx = 3000.0;
  const StereoObservation seen = rig.Observe(caster, lighting, X_WB, RandomStream(2));
  SeenBoard result;
  const Pose X_BG = X_WB.inverse() * BoardPose(board);
  for (int id = 0; id < board.corner_count(); ++id) {
    result.p_B.emplace_back(X_BG * board.Corner(id));
  }
  for (const bool is_right : {false, true}) {
    const auto corners =
        std::get<std::vector<BoardCorner>>(FindBoard(is_right ? seen.right : seen.left, board));
    EXPECT_EQ(corners.size(), result.p_B.size());
    for (const BoardCorner& corner : corners) {
      result.pixels[is_right ? 1 : 0].push_back(corner.pixel);
    }
  }
  return result;
}

class RigGeometryTest : public ::testing::TestWithParam<double> {};

TEST_P(RigGeometryTest, FocalLengthPrincipalPointAndBaselineAreInThePictures) {
  const StereoRigOptions options = Noiseless(GetParam());
  const StereoRig rig(options, RandomStream(1));
  // u = f x/z + c, with x = x_B ± B/2: linear in f, f B and c.
  const auto rows = [](const SeenBoard& seen) { return 4 * static_cast<int>(seen.p_B.size()); };
  std::vector<SeenBoard> boards;
  for (const Viewpoint& viewpoint :
       {Viewpoint{.distance_m = 3.0, .azimuth_rad = 0.4},
        Viewpoint{.distance_m = 4.0, .azimuth_rad = -0.4, .yaw_rad = 0.03, .roll_rad = 0.2},
        Viewpoint{.distance_m = 3.5, .elevation_rad = 0.3, .pitch_rad = 0.03}}) {
    boards.push_back(See(rig, BoardFor(options, viewpoint.distance_m, 0.7), viewpoint));
  }
  int count = 0;
  for (const SeenBoard& seen : boards) count += rows(seen);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, 5);  // f, f B/2, c_u, c_v, Δc_u.
  Eigen::VectorXd pixels(count);
  int row = 0;
  for (const SeenBoard& seen : boards) {
    for (size_t i = 0; i < seen.p_B.size(); ++i) {
      const Eigen::Vector3d& p = seen.p_B[i];
      for (const int side : {0, 1}) {
        const double sign = side == 0 ? 1.0 : -1.0;  // The left camera stands at -B/2.
        const Eigen::Vector2d& pixel = seen.pixels[static_cast<size_t>(side)][i];
        matrix.row(row) << p.x() / p.z(), sign / p.z(), 1.0, 0.0, side;
        pixels[row++] = pixel.x();
        matrix.row(row) << p.y() / p.z(), 0.0, 0.0, 1.0, 0.0;
        pixels[row++] = pixel.y();
      }
    }
  }
  const Eigen::VectorXd found = matrix.colPivHouseholderQr().solve(pixels);
  const CameraParameters& left = rig.cameras().left.parameters();
  EXPECT_NEAR(found[0] / left.fx_px, 1.0, 1e-3);
  EXPECT_NEAR(found[0] / (options.focal_length_m / options.pixel_pitch_m), 1.0, 1e-3);
  EXPECT_NEAR(2.0 * found[1] / found[0] / options.baseline_m, 1.0, 1e-3);
  EXPECT_NEAR(found[2], left.cx_px, 0.1);
  EXPECT_NEAR(found[3], left.cy_px, 0.1);
  EXPECT_NEAR(found[4], 0.0, 0.1);
}

TEST_P(RigGeometryTest, AWallsDisparityIsFocalLengthTimesBaselineOverDistance) {
  const StereoRigOptions options = Noiseless(GetParam());
  const StereoRig rig(options, RandomStream(1));
  const double f_px = options.focal_length_m / options.pixel_pitch_m;
  for (const double distance_m : {2.0, 4.0, 7.0}) {
    const SeenBoard seen = See(rig, BoardFor(options, distance_m, 0.8), {.distance_m = distance_m});
    double sum = 0.0;
    for (size_t i = 0; i < seen.p_B.size(); ++i) {
      const Eigen::Vector2d shift = seen.pixels[0][i] - seen.pixels[1][i];
      sum += shift.x();
      EXPECT_NEAR(shift.x(), f_px * options.baseline_m / distance_m, 0.03) << i;
      EXPECT_NEAR(shift.y(), 0.0, 0.03) << i;
    }
    EXPECT_NEAR(sum / static_cast<double>(seen.p_B.size()), f_px * options.baseline_m / distance_m,
                0.02)
        << distance_m;
  }
}

TEST_P(RigGeometryTest, ABoardsCornersAreWhereARigAsBuiltProjectsThem) {
  StereoRigOptions options = Noiseless(GetParam());
  options.as_designed = false;
  options.distortion = StereoRigOptions().distortion;
  const StereoRig rig(options, RandomStream(4));
  const Viewpoint viewpoint{.distance_m = 3.0, .azimuth_rad = 0.3, .roll_rad = 0.1};
  const SeenBoard seen = See(rig, BoardFor(options, viewpoint.distance_m, 0.85), viewpoint);
  for (size_t i = 0; i < seen.p_B.size(); ++i) {
    const auto left = rig.cameras().left.Project(rig.X_BL().inverse() * seen.p_B[i]);
    const auto right = rig.cameras().right.Project(rig.X_BR().inverse() * seen.p_B[i]);
    EXPECT_LT((seen.pixels[0][i] - *left).norm(), 0.03) << i;
    EXPECT_LT((seen.pixels[1][i] - *right).norm(), 0.03) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, RigGeometryTest, ::testing::Values(4e-3, 6e-3, 8e-3));

}  // namespace
}  // namespace fenestra
