#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <vector>

#include "renderers/ray_caster.h"
#include "renderers/tracing/sobol_samples.h"
#include "tests/renderers/test_scenes.h"

namespace fenestra {
namespace {

constexpr int kSize = 240;
constexpr double kFocal_px = 200.0;
constexpr double kDistance = 2.0;

// An edge leans from the vertical by `tilt_rad`, clockwise, and passes the image point that is so
// far right of and below the image's centre.
struct Edge {
  double tilt_rad = 0.0;
  double right_px = 0.3;
  double below_px = 0.2;
};

// A half-plane that is lit evenly: what is left of its edge, or above it, is bright.
Scene HalfPlane(const Edge& edge) {
  const double tilt_rad = edge.tilt_rad;
  const double m_per_px = kDistance / kFocal_px;
  const Eigen::Vector3d on_edge(edge.right_px * m_per_px, -edge.below_px * m_per_px, 0.0);
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
std::vector<double> EdgeErrors(const Edge& edge, const RenderOptions& options) {
  const double tilt_rad = edge.tilt_rad;
  const RayCaster caster(HalfPlane(edge));
  const RayGrid rays(CameraModel::Pinhole(kSize, kSize, kFocal_px));
  cv::Mat1f image = caster.Render(rays, FacingTheWall({0, 0, kDistance}), OnlySun(0.0, 0.1, 1e5),
                                  options, RandomStream(3));
  const bool steep = tilt_rad < std::numbers::pi / 4.0 + 1e-9;
  const double full = image(steep ? kSize / 2 : 0, steep ? 0 : kSize / 2);
  if (!steep) image = image.t();
  const double perpendicular = steep ? std::cos(tilt_rad) : std::sin(tilt_rad);
  std::vector<double> errors;
  for (int row = 0; row < kSize; ++row) {
    const double across = row - 0.5 * (kSize - 1);
    const double place = steep ? edge.right_px - std::tan(tilt_rad) * (across - edge.below_px)
                               : edge.below_px - (across - edge.right_px) / std::tan(tilt_rad);
    if (std::abs(place) > 0.5 * kSize - 3.0) continue;  // It leaves the image within this row.
    double lit_px = 0.0;
    for (int column = 0; column < kSize; ++column) {
      lit_px += static_cast<double>(image(row, column)) / full;
    }
    errors.push_back((lit_px - (place + 0.5 * kSize)) * perpendicular);
  }
  return errors;
}

// The part of a square around (x, y) that lies left of or above the edge: the square is cut by the
// edge's half-plane (Sutherland and Hodgman), then measured.
double Coverage(const Edge& edge, double x, double y, double side_px = 1.0) {
  // Signed distance from the edge [px], y downwards: positive on the bright side.
  const Eigen::Vector2d bright(-std::cos(edge.tilt_rad), -std::sin(edge.tilt_rad));
  const Eigen::Vector2d on_edge(edge.right_px, edge.below_px);
  const double h = 0.5 * side_px;
  const std::vector<Eigen::Vector2d> corners = {
      {x - h, y - h}, {x + h, y - h}, {x + h, y + h}, {x - h, y + h}};
  std::vector<Eigen::Vector2d> inside;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    const double da = bright.dot(a - on_edge);
    const double db = bright.dot(b - on_edge);
    if (da >= 0.0) inside.push_back(a);
    if ((da >= 0.0) != (db >= 0.0)) inside.push_back(a + (b - a) * (da / (da - db)));
  }
  double area = 0.0;
  for (size_t i = 0; i < inside.size(); ++i) {
    const Eigen::Vector2d& a = inside[i];
    const Eigen::Vector2d& b = inside[(i + 1) % inside.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area / (side_px * side_px);
}

double Rms(const std::vector<double>& errors) {
  double sum = 0.0;
  for (const double e : errors) sum += e * e;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

const std::vector<double> kTilts_deg = {0.0, 0.5, 3.0, 11.0, 30.0, 45.0, 70.0, 88.0, 90.0};

double Radians(double deg) {
  return deg * std::numbers::pi / 180.0;
}

TEST(EdgeSampling, PlacesEdgesToThreeThousandthsOfAPixel) {
  for (const double tilt_deg : kTilts_deg) {
    // At 45 degrees all rows cut the edge alike, so its place within the pixels matters.
    for (const double below_px : {0.0, 0.2}) {
      const auto errors = EdgeErrors({.tilt_rad = Radians(tilt_deg), .below_px = below_px},
                                     {.edge_samples_per_pixel = kMostPixelSamples});
      ASSERT_GT(errors.size(), 80u) << tilt_deg;
      // The RMS of n normal numbers is known to 1/√(2n); 4 of these: false alarm 3e-5.
      const double sampling = 4.0 / std::sqrt(2.0 * static_cast<double>(errors.size()));
      EXPECT_LT(Rms(errors), 0.003 * (1.0 + sampling)) << tilt_deg << " degrees";
      RecordProperty(
          "rms_mpx_at_" + std::to_string(tilt_deg) + "_deg_below_" + std::to_string(below_px),
          std::to_string(1e3 * Rms(errors)));
    }
  }
}

TEST(EdgeSampling, FourLinesPlaceEdgesToSixThousandthsOfAPixel) {
  for (const double tilt_deg : kTilts_deg) {
    const Edge edge{.tilt_rad = Radians(tilt_deg), .below_px = 0.2};
    const auto errors = EdgeErrors(
        edge,
        {.samples_per_pixel = 1, .edge_samples_per_pixel = 64, .edge_lines = EdgeLines::kFour});
    ASSERT_GT(errors.size(), 80u) << tilt_deg;
    const double sampling = 4.0 / std::sqrt(2.0 * static_cast<double>(errors.size()));
    EXPECT_LT(Rms(errors), 0.006 * (1.0 + sampling)) << tilt_deg << " degrees";
    RecordProperty("rms_mpx_at_" + std::to_string(tilt_deg), std::to_string(1e3 * Rms(errors)));
  }
}

TEST(EdgeSampling, PixelsGetTheAreaThatTheEdgeLeavesThem) {
  for (const double tilt_deg : kTilts_deg) {
    const Edge edge{.tilt_rad = Radians(tilt_deg)};
    const RayCaster caster(HalfPlane(edge));
    const RayGrid rays(CameraModel::Pinhole(kSize, kSize, kFocal_px));
    const cv::Mat1f image = caster.Render(rays, FacingTheWall({0, 0, kDistance}),
                                          OnlySun(0.0, 0.1, 1e5), {}, RandomStream(4));
    double full = 0.0;
    cv::minMaxLoc(image, nullptr, &full);
    int crossed = 0;
    double sum = 0.0;
    for (int v = 0; v < kSize; ++v) {
      for (int u = 0; u < kSize; ++u) {
        const double area = Coverage(edge, u - 0.5 * (kSize - 1), v - 0.5 * (kSize - 1));
        const double error = static_cast<double>(image(v, u)) / full - area;
        // A corner that four stratified samples and those of eight neighbours miss is small.
        EXPECT_LT(std::abs(error), 0.03) << tilt_deg << ": " << u << ", " << v;
        if (area <= 0.0 || area >= 1.0) continue;
        sum += error * error;
        ++crossed;
      }
    }
    EXPECT_GT(crossed, kSize / 2);
    EXPECT_LT(std::sqrt(sum / crossed), 0.0025) << tilt_deg;
  }
}

TEST(EdgeSampling, QuartersOfPixelsGetTheirAreasToo) {
  for (const double tilt_deg : kTilts_deg) {
    const Edge edge{.tilt_rad = Radians(tilt_deg)};
    const RayCaster caster(HalfPlane(edge));
    const RayGrid rays(CameraModel::Pinhole(kSize, kSize, kFocal_px));
    const Pose X_WC = FacingTheWall({0, 0, kDistance});
    const Lighting sun = OnlySun(0.0, 0.1, 1e5);
    const cv::Mat1f whole = caster.Render(rays, X_WC, sun, {}, RandomStream(4));
    const QuarterImages quarters = caster.RenderQuarters(rays, X_WC, sun, {}, RandomStream(4));
    double full = 0.0;
    cv::minMaxLoc(whole, nullptr, &full);
    cv::Mat1f mean = cv::Mat1f::zeros(whole.size());
    double sum = 0.0;
    int crossed = 0;
    for (size_t q = 0; q < quarters.size(); ++q) {
      const cv::Mat1f& quarter = quarters[q];
      mean += 0.25 * quarter;
      for (int v = 0; v < kSize; ++v) {
        for (int u = 0; u < kSize; ++u) {
          const double x = u - 0.5 * (kSize - 1) + (q % 2 == 0 ? -0.25 : 0.25);
          const double y = v - 0.5 * (kSize - 1) + (q / 2 == 0 ? -0.25 : 0.25);
          const double area = Coverage(edge, x, y, 0.5);
          const double error = static_cast<double>(quarter(v, u)) / full - area;
          EXPECT_LT(std::abs(error), 0.07) << tilt_deg << ": " << u << ", " << v;
          if (area <= 0.0 || area >= 1.0) continue;
          sum += error * error;
          ++crossed;
        }
      }
    }
    EXPECT_LT(cv::norm(mean, whole, cv::NORM_INF), 1e-5 * full);
    EXPECT_LT(std::sqrt(sum / crossed), 0.006) << tilt_deg;
  }
}

// The twin with a fault: the base samples alone do not do it.
TEST(EdgeSampling, FourSamplesAreNotEnough) {
  for (const double tilt_deg : kTilts_deg) {
    EXPECT_GT(Rms(EdgeErrors({.tilt_rad = Radians(tilt_deg)}, {.edge_samples_per_pixel = 4})), 0.02)
        << tilt_deg;
  }
}

TEST(EdgeSampling, ErrorsOfNeighbouringRowsAreIndependent) {
  const auto errors = EdgeErrors({}, {.edge_samples_per_pixel = kMostPixelSamples});
  double product = 0.0;
  for (size_t i = 1; i < errors.size(); ++i) product += errors[i] * errors[i - 1];
  const auto n = static_cast<double>(errors.size());
  const double correlation = product / (n * std::pow(Rms(errors), 2));
  // The mean of n products of independent numbers: 4 standard deviations, false alarm 6e-5.
  EXPECT_LT(std::abs(correlation), 4.0 / std::sqrt(n));
}

TEST(EdgeSampling, PixelsAwayFromEdgesKeepTheirBaseSamples) {
  const RayCaster caster(HalfPlane({.tilt_rad = 0.2}));
  const RayGrid rays(CameraModel::Pinhole(kSize, kSize, kFocal_px));
  const Pose X_WC = FacingTheWall({0, 0, kDistance});
  Lighting lighting = OnlySky(1e4, 0.2);
  const cv::Mat1f few =
      caster.Render(rays, X_WC, lighting, {.edge_samples_per_pixel = 4}, RandomStream(3));
  const cv::Mat1f many = caster.Render(rays, X_WC, lighting, {}, RandomStream(3));
  const double differing = cv::countNonZero(few != many);
  EXPECT_GT(differing, kSize);        // More than a pixel in each row, but
  EXPECT_LT(differing, 5.0 * kSize);  // only a narrow band.
}

}  // namespace
}  // namespace fenestra
