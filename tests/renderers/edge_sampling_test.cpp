#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <set>
#include <vector>

#include "renderers/net_samples.h"
#include "renderers/ray_caster.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

constexpr int kSize = 240;
constexpr double kFocal_px = 200.0;
constexpr double kDistance = 2.0;

// A half-plane that is lit evenly. Its edge passes the image point (100.3, 0) px right of and below
// the centre, leaning by `tilt_rad` from the vertical; the image is dark right of it.
Scene HalfPlane(double tilt_rad) {
  const double m_per_px = kDistance / kFocal_px;
  const Eigen::Vector3d on_edge(0.3 * m_per_px, 0.0, 0.0);
  const Eigen::Vector3d along(std::sin(tilt_rad), std::cos(tilt_rad), 0.0);
  const Eigen::Vector3d left(-std::cos(tilt_rad), std::sin(tilt_rad), 0.0);
  std::vector<glm::vec3> corners;
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(on_edge - 5.0 * along), Eigen::Vector3d(on_edge + 5.0 * along),
        Eigen::Vector3d(on_edge + 5.0 * along + 5.0 * left),
        Eigen::Vector3d(on_edge - 5.0 * along + 5.0 * left)}) {
    corners.emplace_back(p.x(), p.y(), p.z());
  }
  Scene scene;
  scene.materials = {Grey(0.5f)};
  scene.meshes = {Polygon(corners, 0)};
  return scene;
}

// For each row (for an edge nearer the horizontal: each column), where the row's light says that
// the edge is, minus where it is [px].
std::vector<double> EdgeErrors(double tilt_rad, int edge_samples) {
  const RayCaster caster(HalfPlane(tilt_rad));
  const RayGrid rays(CameraModel::Pinhole(kSize, kSize, kFocal_px));
  cv::Mat1f image = caster.Render(rays, FacingTheWall({0, 0, kDistance}), OnlySun(0.0, 0.1, 1e5),
                                  {.edge_samples_per_pixel = edge_samples}, RandomStream(3));
  const bool steep = std::abs(tilt_rad) < std::numbers::pi / 4.0 + 1e-9;
  const double slope = steep ? -std::tan(tilt_rad) : -1.0 / std::tan(tilt_rad);
  const double centre = 0.5 * (kSize - 1);
  const double full = image(kSize / 2, steep ? 0 : 0);
  if (!steep) image = image.t();
  std::vector<double> errors;
  for (int row = 0; row < kSize; ++row) {
    // Along a row: x = 0.3 - tan(tilt) y_down; along a column: y_down = -(x - 0.3)/tan(tilt).
    const double across = row - centre;
    const double edge = steep ? 0.3 + slope * across : slope * (across - 0.3);
    if (std::abs(edge) > 0.5 * kSize - 3.0) continue;  // It leaves the image within this row.
    double lit_px = 0.0;
    for (int column = 0; column < kSize; ++column) {
      lit_px += static_cast<double>(image(row, column)) / full;
    }
    const double lit_from_start = steep || slope > 0.0 ? lit_px : kSize - lit_px;
    errors.push_back(lit_from_start - (edge + 0.5 * kSize));
  }
  return errors;
}

double Rms(const std::vector<double>& errors) {
  double sum = 0.0;
  for (const double e : errors) sum += e * e;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

// In degrees. At 90 the edge is a row's border's parallel, and so on.
const std::vector<double> kTilts_deg = {0.0, 0.5, 3.0, 11.0, 30.0, 45.0, 70.0, 88.0, 90.0};

TEST(EdgeSampling, PlacesEdgesToSixThousandthsOfAPixel) {
  for (const double tilt_deg : kTilts_deg) {
    const auto errors = EdgeErrors(tilt_deg * std::numbers::pi / 180.0, 256);
    ASSERT_GT(errors.size(), 80u) << tilt_deg;
    EXPECT_LT(Rms(errors), 0.006) << tilt_deg << " degrees";
    RecordProperty("rms_mpx_at_" + std::to_string(static_cast<int>(tilt_deg * 10)),
                   std::to_string(1e3 * Rms(errors)));
  }
}

// The twin with a fault: the base samples alone do not do it.
TEST(EdgeSampling, FourSamplesAreNotEnough) {
  for (const double tilt_deg : kTilts_deg) {
    EXPECT_GT(Rms(EdgeErrors(tilt_deg * std::numbers::pi / 180.0, 4)), 0.02) << tilt_deg;
  }
}

TEST(EdgeSampling, ErrorsOfNeighbouringRowsAreIndependent) {
  const auto errors = EdgeErrors(0.0, 256);
  double product = 0.0;
  for (size_t i = 1; i < errors.size(); ++i) product += errors[i] * errors[i - 1];
  const auto n = static_cast<double>(errors.size());
  const double correlation = product / (n * std::pow(Rms(errors), 2));
  // The mean of n products of independent numbers: 4 standard deviations, false alarm 6e-5.
  EXPECT_LT(std::abs(correlation), 4.0 / std::sqrt(n));
}

TEST(EdgeSampling, PixelsAwayFromEdgesKeepTheirBaseSamples) {
  const RayCaster caster(HalfPlane(0.2));
  const RayGrid rays(CameraModel::Pinhole(kSize, kSize, kFocal_px));
  const Pose X_WC = FacingTheWall({0, 0, kDistance});
  Lighting lighting = OnlySky(1e4, 0.2);
  const cv::Mat1f few = caster.Render(rays, X_WC, lighting, {.edge_samples_per_pixel = 4},
                                      RandomStream(3));
  const cv::Mat1f many = caster.Render(rays, X_WC, lighting, {}, RandomStream(3));
  const double differing = cv::countNonZero(few != many);
  EXPECT_GT(differing, kSize);        // More than a pixel in each row, but
  EXPECT_LT(differing, 5.0 * kSize);  // only a narrow band.
}

TEST(NetSamples, StayStratifiedUnderScrambling) {
  for (const uint64_t pixel : {0u, 1u, 752u * 480u}) {
    const NetPoint scramble = ScrambleOf(99, pixel);
    for (const int bits_x : {0, 1, 4, 7, 8}) {  // All shapes of elementary intervals of area 1/256.
      std::set<uint32_t> intervals;
      for (size_t i = 0; i < kMostPixelSamples; ++i) {
        const uint64_t x = kNetTable.x[i] ^ scramble.x;
        const uint64_t y = kNetTable.y[i] ^ scramble.y;
        const int bits_y = 8 - bits_x;
        intervals.insert(static_cast<uint32_t>(((x << bits_x) >> 32) << bits_y |
                                               ((y << bits_y) >> 32)));
      }
      EXPECT_EQ(intervals.size(), 256u) << bits_x;
    }
  }
}

}  // namespace
}  // namespace fenestra
