#include "scenes/targets/board_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <functional>

#include "core/io/input_error.h"
#include "scenes/targets/flat_targets.h"

namespace fenestra {
namespace {

constexpr double kSigma = 1e-3;
const CalibrationBoard kBoard;
const Eigen::Vector2d kSize(kBoard.width_m(), kBoard.height_m());

TEST(BoardShape, AsDrawnEveryPointIsWhereTheDrawingHasIt) {
  const BoardShape shape(kBoard, kAsDrawn, RandomStream(1));
  for (int id = 0; id < kBoard.corner_count(); ++id) {
    EXPECT_EQ(shape.At(kBoard.Corner(id).head<2>()), kBoard.Corner(id));
  }
}

// Whether a quantity of boards, in its standard deviations, is normal with variance 1: the sum of
// squares over 400 boards is χ², tested two-sided, wrong once in 10⁵.
bool HasUnitVariance(const BoardTolerances& tolerances,
                     const std::function<double(const BoardShape&)>& quantity) {
  constexpr int kBoards = 400;
  const boost::math::chi_squared law(kBoards);
  double sum = 0.0;
  for (uint64_t seed = 0; seed < kBoards; ++seed) {
    const double q = quantity(BoardShape(kBoard, tolerances, RandomStream(seed)));
    sum += q * q;
  }
  return sum > quantile(law, 5e-6) && sum < quantile(complement(law, 5e-6));
}

BoardTolerances With(double BoardTolerances::*tolerance) {
  BoardTolerances tolerances = kAsDrawn;
  tolerances.*tolerance = kSigma;
  return tolerances;
}

double HeightAt(const BoardShape& shape, double share_x, double share_y) {
  return shape.At({share_x * kSize.x(), share_y * kSize.y()}).z() / (kSigma * kSize.norm());
}

TEST(BoardShape, BowsAreSagittasAndTwistLeavesTheAxesFlat) {
  const BoardTolerances bow = With(&BoardTolerances::bow);
  const auto along_rows = [](const BoardShape& shape) { return HeightAt(shape, 1.0, 0.5); };
  EXPECT_TRUE(HasUnitVariance(bow, along_rows));
  EXPECT_TRUE(HasUnitVariance(bow, [](const BoardShape& s) { return HeightAt(s, 0.5, 0.0); }));
  EXPECT_TRUE(HasUnitVariance(bow, [](const BoardShape& s) {
    return 0.5 * (HeightAt(s, 1.0, 1.0) - HeightAt(s, 0.0, 1.0));
  }));
  // The twins: bows that are a third too large or too small.
  for (const double wrong : {0.75, 1.33}) {
    EXPECT_FALSE(HasUnitVariance(bow, [&](const BoardShape& s) { return wrong * along_rows(s); }));
  }
}

TEST(BoardShape, LinesErrIndependentlyAndAsAWhole) {
  const BoardTolerances lines = With(&BoardTolerances::line_error);
  const auto error = [](const BoardShape& shape, int id) {
    const Eigen::Vector3d drawn = kBoard.Corner(id);
    return Eigen::Vector2d((shape.At(drawn.head<2>()) - drawn).head<2>() /
                           (kSigma * kBoard.square_m));
  };
  const int below = kBoard.corner_columns();  // Corner 0's neighbour in its column.
  EXPECT_TRUE(HasUnitVariance(lines, [&](const BoardShape& s) { return error(s, 0).x(); }));
  EXPECT_TRUE(HasUnitVariance(lines, [&](const BoardShape& s) {
    return (error(s, 1).x() - error(s, 0).x()) / std::sqrt(2.0);
  }));
  EXPECT_TRUE(HasUnitVariance(lines, [&](const BoardShape& s) {
    return (error(s, below).y() - error(s, 0).y()) / std::sqrt(2.0);
  }));
  const BoardShape shape(kBoard, lines, RandomStream(1));
  EXPECT_NEAR(error(shape, below).x(), error(shape, 0).x(), 1e-9);
}

TEST(BoardShape, ThePrintIsScaledAboutItsCentre) {
  const auto stretch = [](const BoardShape& s, int axis) {
    const Eigen::Vector2d end = axis == 0 ? Eigen::Vector2d(kSize.x(), 0.5 * kSize.y())
                                          : Eigen::Vector2d(0.5 * kSize.x(), kSize.y());
    return ((s.At(end).head<2>() - end)[axis]) / (0.5 * kSize[axis] * kSigma);
  };
  EXPECT_TRUE(HasUnitVariance(With(&BoardTolerances::print_scale), [&](const BoardShape& s) {
    return 0.5 * (stretch(s, 0) + stretch(s, 1));
  }));
  EXPECT_TRUE(HasUnitVariance(With(&BoardTolerances::print_anisotropy),
                              [&](const BoardShape& s) { return stretch(s, 0) - stretch(s, 1); }));
}

TEST(BoardShape, TheSceneHasTheCornersWhereTheShapeHasThem) {
  const BoardShape shape(kBoard, {}, RandomStream(5));
  const Scene scene = MakeBoardScene({.board = kBoard, .shape = shape});
  EXPECT_NO_THROW(Validate(scene));
  const Pose X_WG = BoardPose(kBoard);
  for (int id = 0; id < kBoard.corner_count(); ++id) {
    const Eigen::Vector3d p_W = X_WG * shape.At(kBoard.Corner(id).head<2>());
    double nearest_m = 1.0;
    for (const Mesh& mesh : scene.meshes) {
      for (const glm::vec3& q : mesh.positions_W) {
        nearest_m = std::min(nearest_m, (p_W - Eigen::Vector3d(q.x, q.y, q.z)).norm());
      }
    }
    EXPECT_LT(nearest_m, 1e-7) << id;  // Single precision at 0.3 m.
    EXPECT_GT((p_W - X_WG * kBoard.Corner(id)).norm(), 1e-5) << id;
  }
}

TEST(BoardShape, NegativeTolerancesAreRefused) {
  EXPECT_THROW(Validate(BoardTolerances{.bow = -1e-3}), InputError);
  EXPECT_NO_THROW(Validate(BoardTolerances{}));
}

}  // namespace
}  // namespace fenestra
