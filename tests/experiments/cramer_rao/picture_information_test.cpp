#include "experiments/cramer_rao/picture_information.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

// Laws of a picture's information that hold whatever its pixels are worth. That it is what all
// pixels of exact pictures tell is tested with two cameras, in stereo_information_test.cpp.

namespace fenestra {
namespace {

constexpr double kFocal_px = 300.0;
constexpr double kDistance_m = 3.0;
const PointSpread kSpread{.centre_sigma_px = 0.5, .corner_sigma_px = 0.5};
// The frame's unknowns, the blur, levels; then the camera's and the pose's.
constexpr int kBlur = kFrameUnknowns;
constexpr int kLevels = kBlur + 1;
constexpr int kCamera = kLevels + kLevelsOfPicture;
constexpr int kPose = kCamera + 9;
constexpr int kAll = kPose + 6;

CameraModel Camera() {
  return CameraModel::Pinhole(320, 240, kFocal_px);
}

FrameState Frame(double turn_rad = 0.0) {
  const Eigen::Matrix3d facing = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return {.X_CO = Pose(RotationFromVector({0.0, turn_rad, 0.0}) * facing, {0.0, 0.0, kDistance_m}),
          .width_m = 1.2,
          .height_m = 1.0,
          .border_m = 0.15};
}

struct Levels {
  double wall_e = 9000.0;
  double frame_e = 800.0;
  double opening_e = 3000.0;
};

// Electrons of the frame as it faces the camera; beside the edges only their levels count.
cv::Mat1f Electrons(const FrameState& frame, const Levels& levels, double scale = 1.0) {
  const CameraModel camera = Camera();
  cv::Mat1f electrons(camera.height_px(), camera.width_px());
  const Eigen::Vector3d normal = frame.X_CO.rotation().col(2);
  for (int v = 0; v < electrons.rows; ++v) {
    for (int u = 0; u < electrons.cols; ++u) {
      const Eigen::Vector3d ray = camera.UnprojectRay({u, v}).value();
      const Eigen::Vector3d p_C = normal.dot(frame.X_CO.translation()) / normal.dot(ray) * ray;
      const Eigen::Vector3d p_O = frame.X_CO.inverse() * p_C;
      const double outside_m = std::max(std::abs(p_O.x()) - 0.5 * frame.width_m,
                                        std::abs(p_O.y()) - 0.5 * frame.height_m);
      const double e = outside_m > 0.0               ? levels.wall_e
                       : outside_m > -frame.border_m ? levels.frame_e
                                                     : levels.opening_e;
      electrons(v, u) = static_cast<float>(scale * e);
    }
  }
  return electrons;
}

// Shot noise alone, unless told otherwise.
PixelNoise Noise(double saturation_e = 1e5) {
  ImageSensorOptions sensor;
  sensor.saturation_e = saturation_e;
  sensor.read_noise_e = 0.0;
  sensor.dark_current_e_s = 0.0;
  sensor.fixed_pattern = false;
  sensor.adc_bits = 16;
  sensor.output_bits = 16;
  sensor.black_level_dn = 0.0;
  return PixelNoise::Linear(sensor, {.exposure_s = 1e-3, .gain = 1.0});
}

std::optional<Eigen::MatrixXd> InformationIn(const FrameState& frame, const cv::Mat1f& electrons,
                                             const PixelNoise& noise) {
  const CameraModel camera = Camera();
  return PictureInformation(frame,
                            {.camera = camera,
                             .X_VC = Pose(),
                             .electrons = electrons,
                             .noise = noise,
                             .spread = kSpread,
                             .blur_unknown = kBlur,
                             .level_unknown = kLevels,
                             .camera_unknown = kCamera,
                             .pose_unknown = kPose},
                            kAll);
}

Eigen::MatrixXd Usual(const FrameState& frame) {
  const auto information = InformationIn(frame, Electrons(frame, {}), Noise(20000.0));
  EXPECT_TRUE(information.has_value());
  return information.value_or(Eigen::MatrixXd::Zero(kAll, kAll));
}

// By their own standard deviations, since unknowns have different units.
Eigen::MatrixXd Scaled(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd scale =
      information.diagonal().unaryExpr([](double d) { return d > 0.0 ? 1.0 / std::sqrt(d) : 0.0; });
  return scale.asDiagonal() * information * scale.asDiagonal();
}

TEST(PictureInformation, IsSymmetricAndNowhereNegative) {
  const Eigen::MatrixXd scaled = Scaled(Usual(Frame(0.4)));
  EXPECT_LT((scaled - scaled.transpose()).norm(), 1e-9);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues().minCoeff(), -1e-9);
}

// One picture does not tell a near small frame from a far large one.
TEST(PictureInformation, TellsNothingOfTheScaleOfAllLengths) {
  const FrameState frame = Frame(0.4);
  const Eigen::MatrixXd information = Usual(frame).topLeftCorner<kFrameUnknowns, kFrameUnknowns>();
  Eigen::Matrix<double, kFrameUnknowns, 1> scale;
  scale << frame.X_CO.translation(), 0.0, 0.0, 0.0, frame.width_m, frame.height_m, frame.border_m;
  const double along = scale.dot(information * scale);
  const double of_distance = std::pow(kDistance_m, 2) * information(2, 2);
  EXPECT_LT(std::abs(along), 1e-9 * of_distance);
  // The twin: the distance alone is told very well.
  EXPECT_GT(of_distance, 1e4);
}

// Before a camera that they face squarely, a shift of the frame and one of the principal point are
// the same, f/z pixels a metre.
TEST(PictureInformation, OfThePrincipalPointIsThatOfTheFramesPlace) {
  const Eigen::MatrixXd information = Usual(Frame());
  const double px_per_m = kFocal_px / kDistance_m;
  for (int axis = 0; axis < 2; ++axis) {
    const int point = kCamera + 2 + axis;
    EXPECT_NEAR(information(axis, axis), px_per_m * px_per_m * information(point, point),
                1e-9 * information(axis, axis));
    EXPECT_NEAR(information(axis, axis), px_per_m * information(axis, point),
                1e-9 * information(axis, axis));
  }
}

TEST(PictureInformation, OfTheCamerasPlaceIsThatOfTheFrames) {
  const Eigen::MatrixXd information = Usual(Frame(0.4));
  for (int axis = 0; axis < 3; ++axis) {
    const double own = information(axis, axis);
    EXPECT_NEAR(information(kPose + 3 + axis, kPose + 3 + axis), own, 1e-9 * own);
    EXPECT_NEAR(information(kPose + 3 + axis, axis), own, 1e-9 * own);
  }
}

TEST(PictureInformation, AMirroredFrameHasTheMirroredInformation) {
  const Eigen::MatrixXd left = Usual(Frame(0.3)).topLeftCorner<6, 6>();
  const Eigen::MatrixXd right = Usual(Frame(-0.3)).topLeftCorner<6, 6>();
  // x and the turns about y and z change their signs.
  Eigen::Matrix<double, 6, 1> mirror;
  mirror << -1.0, 1.0, 1.0, 1.0, -1.0, -1.0;
  const Eigen::MatrixXd expected = mirror.asDiagonal() * left * mirror.asDiagonal();
  // Every other line of pixels counts, and mirrored ones are those in between.
  EXPECT_LT((Scaled(expected) - Scaled(right)).norm(), 0.02);
}

// F = Σ ∂μ∂μᵀ/V: with V = μ, k times the light is k times the information on what moves edges; what
// V itself tells, (∂V/V)²/2, does not grow and is a thousandth of it here.
TEST(PictureInformation, GrowsWithTheLightAsShotNoiseSays) {
  const FrameState frame = Frame(0.2);
  const auto once = InformationIn(frame, Electrons(frame, {}), Noise());
  const auto fourfold = InformationIn(frame, Electrons(frame, {}, 4.0), Noise());
  ASSERT_TRUE(once && fourfold);
  for (int i = 0; i < kFrameUnknowns; ++i) {
    EXPECT_NEAR((*fourfold)(i, i) / (*once)(i, i), 4.0, 0.01) << i;
  }
}

TEST(PictureInformation, AFrameAsBrightAsItsWallIsNotSeen) {
  const FrameState frame = Frame();
  const Levels even{.wall_e = 5000.0, .frame_e = 5000.0, .opening_e = 5000.0};
  const auto information = InformationIn(frame, Electrons(frame, even), Noise());
  ASSERT_TRUE(information.has_value());
  EXPECT_LT((information->topLeftCorner<kFrameUnknowns, kFrameUnknowns>().norm()), 1e-6);
  // Each side's levels are still told.
  EXPECT_GT((*information)(kLevels, kLevels), 0.0);
}

TEST(PictureInformation, SaturatedPixelsTellNothing) {
  const FrameState frame = Frame();
  const auto all = InformationIn(frame, Electrons(frame, {}), Noise(20000.0));
  const auto no_wall = InformationIn(frame, Electrons(frame, {}), Noise(5000.0));
  const auto none = InformationIn(frame, Electrons(frame, {}), Noise(500.0));
  ASSERT_TRUE(all && no_wall && none);
  EXPECT_LT((*no_wall)(0, 0), (*all)(0, 0));
  EXPECT_GT((*no_wall)(0, 0), 0.0);
  EXPECT_EQ(none->norm(), 0.0);
}

TEST(PictureInformation, EachSideHasLevelsOfItsOwn) {
  const Eigen::MatrixXd information = Usual(Frame());
  for (int a = 0; a < kSides; ++a) {
    for (int b = 0; b < kSides; ++b) {
      const Eigen::Matrix3d mixed = information.block<3, 3>(kLevels + 3 * a, kLevels + 3 * b);
      if (a == b) {
        EXPECT_GT(mixed.diagonal().minCoeff(), 0.0) << a;
      } else {
        EXPECT_EQ(mixed.norm(), 0.0) << a << ", " << b;
      }
    }
  }
}

TEST(PictureInformation, WhereACornerIsNotSeenThereIsNone) {
  FrameState frame = Frame();
  frame.X_CO = Pose(frame.X_CO.rotation(), {1.2, 0.0, kDistance_m});
  EXPECT_FALSE(InformationIn(frame, Electrons(frame, {}), Noise()));
  frame.X_CO = Pose(frame.X_CO.rotation(), {0.0, 0.0, -kDistance_m});
  EXPECT_FALSE(InformationIn(frame, Electrons(Frame(), {}), Noise()));
}

}  // namespace
}  // namespace fenestra
