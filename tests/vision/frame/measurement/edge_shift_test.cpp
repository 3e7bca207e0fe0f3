#include "vision/frame/measurement/edge_shift.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random/random_stream.h"

namespace fenestra {
namespace {

// By third-order coma that vanishes at `centre`, but for a factor.
Eigen::Vector2d DisplacementByComa(const Eigen::Vector2d& place, const Eigen::Vector2d& centre) {
  const Eigen::Vector2d s = place - centre;
  return s.squaredNorm() * s;
}

TEST(EdgeShift, GrowsFromTheCentreToTheCorners) {
  const CameraModel camera({.width_px = 752,
                            .height_px = 480,
                            .fx_px = 667.0,
                            .fy_px = 667.0,
                            .cx_px = 370.0,
                            .cy_px = 250.0,
                            .distortion = {}});
  const EdgeShift shift{.centre_px = 0.003, .corner_px = 0.018};
  EXPECT_NEAR(shift.SigmaAt(PlaceInImage(camera, {375.5, 239.5})), 0.003, 1e-12);
  for (const double u : {-0.5, 751.5}) {
    EXPECT_NEAR(shift.SigmaAt(PlaceInImage(camera, {u, -0.5})), 0.018, 1e-12);
  }
}

// Of 1e5 lenses the correlation is known to 0.01, as displacements have a kurtosis of 12 or so.
TEST(EdgeShift, IsCorrelatedAsDisplacementsByDecentredComaAre) {
  constexpr int kLenses = 100000;
  for (const double apart : {0.1, 0.3, 0.5, 0.6}) {
    const Eigen::Vector2d a(0.5 * apart, 0.0);
    const Eigen::Vector2d b = -a;
    double product = 0.0;
    double square_a = 0.0;
    double square_b = 0.0;
    for (int lens = 0; lens < kLenses; ++lens) {
      const RandomStream stream = RandomStream(5).Child("lens", static_cast<uint64_t>(lens));
      const Eigen::Vector2d centre(0.3 * stream.Child("x").Normal(0),
                                   0.3 * stream.Child("y").Normal(0));
      const double at_a = DisplacementByComa(a, centre).x();
      const double at_b = DisplacementByComa(b, centre).x();
      product += at_a * at_b;
      square_a += at_a * at_a;
      square_b += at_b * at_b;
    }
    const double correlation = product / std::sqrt(square_a * square_b);
    EXPECT_NEAR(ShiftCorrelation(a, b), correlation, 0.05 + 0.03) << apart;
  }
}

}  // namespace
}  // namespace fenestra
