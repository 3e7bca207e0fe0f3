#include "renderers/light/lane_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random/random_stream.h"
#include "renderers/tracing/triangle_soup.h"

// The loops are written once for all instruction sets; here each lane is compared with the same
// sentence in double precision.

namespace fenestra {
namespace {

constexpr double kLaneRounding = 1e-6;

Lanes<float> RandomLanes(uint64_t seed, double low, double high) {
  const RandomStream stream(seed);
  Lanes<float> lanes;
  for (int i = 0; i < kLanes; ++i) {
    lanes[i] = static_cast<float>(low + (high - low) * stream.Uniform(static_cast<uint64_t>(i)));
  }
  return lanes;
}

// Rays from one point that have hit triangles with these normals.
RayPacket Hits(const glm::vec3& origin_W, const Directions& directions_W, const Directions& normals,
               const Lanes<float>& t) {
  RayPacket packet;
  SetRays(packet, origin_W, directions_W);
  for (int i = 0; i < kLanes; ++i) {
    packet.ray.tfar[i] = t[i];
    packet.hit.Ng_x[i] = normals.x[i];
    packet.hit.Ng_y[i] = normals.y[i];
    packet.hit.Ng_z[i] = normals.z[i];
    packet.hit.primID[i] = static_cast<uint32_t>(i % 5);
    packet.hit.geomID[i] = 0;
    packet.hit.u[i] = 0.04f * static_cast<float>(i);
    packet.hit.v[i] = 0.3f;
  }
  return packet;
}

Directions RandomDirections(uint64_t seed) {
  return {RandomLanes(seed, -1.0, 1.0), RandomLanes(seed + 1, -1.0, 1.0),
          RandomLanes(seed + 2, -1.0, 1.0)};
}

Eigen::Vector3d Of(const Directions& directions, int lane) {
  return {directions.x[lane], directions.y[lane], directions.z[lane]};
}

TEST(LaneKernels, DirectionsAreThoseOfTheCamerasPose) {
  const Pose X_WC(RotationFromVector({0.3, -0.5, 0.8}), {1.0, 2.0, -3.0});
  const FloatPose pose = ToFloat(X_WC);
  EXPECT_EQ(pose.p_WC, glm::vec3(1.0f, 2.0f, -3.0f));
  const Lanes<float> x = RandomLanes(1, -0.6, 0.6);
  const Lanes<float> y = RandomLanes(2, -0.4, 0.4);
  const Directions found = ToWorld(pose.axes, x, y);
  for (int i = 0; i < kLanes; ++i) {
    const Eigen::Vector3d expected = X_WC.rotation() * Eigen::Vector3d(x[i], y[i], 1.0);
    EXPECT_LT((Of(found, i) - expected).norm(), kLaneRounding) << i;
    // Not normalised: a hit's t is its depth along the optical axis.
    EXPECT_NEAR(Of(found, i).dot(X_WC.rotation().col(2)), 1.0, kLaneRounding);
  }
}

TEST(LaneKernels, ABlockOfPixelsIsASquareRowByRow) {
  const ImageScramble scramble(99);
  const PixelBlock block = MakePixelBlock(1000, 753, 500, 752, scramble);
  for (uint32_t i = 0; i < kLanes; ++i) {
    const uint32_t column = i % kBlockSide;
    const uint32_t row = i / kBlockSide;
    EXPECT_EQ(block.corner.v[i], 1000 + row * 753 + column);
    const SobolPoint seed = scramble.OfPixel(500 + row * 752 + column);
    EXPECT_EQ(block.seed_x.v[i], seed.x);
    EXPECT_EQ(block.seed_y.v[i], seed.y);
  }
}

TEST(LaneKernels, SamplesAreTheScrambledPointsOfTheNet) {
  Lanes<uint32_t> net_x, net_y, seed_x, seed_y;
  for (uint32_t i = 0; i < kLanes; ++i) {
    net_x.v[i] = kSobolTable.x[3 * i];
    net_y.v[i] = kSobolTable.y[3 * i];
    seed_x.v[i] = Hashed(i);
    seed_y.v[i] = Hashed(i + 100);
  }
  const PixelPoints points = ScrambledPoints(net_x, net_y, seed_x, seed_y);
  for (uint32_t i = 0; i < kLanes; ++i) {
    EXPECT_EQ(points.s.v[i], ToUnit(OwenScrambled(net_x.v[i], seed_x.v[i])));
    EXPECT_EQ(points.t.v[i], ToUnit(OwenScrambled(net_y.v[i], seed_y.v[i])));
    EXPECT_GE(points.s.v[i], 0.0f);
    EXPECT_LT(points.s.v[i], 1.0f);
  }
}

TEST(LaneKernels, RaysInAPixelAreInterpolatedBetweenItsCorners) {
  constexpr uint32_t kStride = 7;
  std::vector<float> corners;  // x and y of each.
  const RandomStream stream(4);
  for (uint64_t i = 0; i < 2 * kStride * 6; ++i)
    corners.push_back(static_cast<float>(stream.Uniform(i)));
  Lanes<uint32_t> corner;
  for (uint32_t i = 0; i < kLanes; ++i) corner.v[i] = i % 6 + kStride * (i % 5);
  const PixelPatches patches = PatchesOf(corners.data(), corner, kStride);
  const PixelPoints points{RandomLanes(5, 0.0, 1.0), RandomLanes(6, 0.0, 1.0)};
  const ImagePoints found = InPixels(patches, points);
  for (int i = 0; i < kLanes; ++i) {
    const double s = points.s[i];
    const double t = points.t[i];
    for (uint32_t axis : {0u, 1u}) {
      const auto at = [&](uint32_t column, uint32_t row) -> double {
        return corners[2 * (corner[i] + row * kStride + column) + axis];
      };
      const double expected =
          (1 - t) * ((1 - s) * at(0, 0) + s * at(1, 0)) + t * ((1 - s) * at(0, 1) + s * at(1, 1));
      EXPECT_NEAR(axis == 0 ? found.x[i] : found.y[i], expected, kLaneRounding) << i;
    }
  }
}

TEST(LaneKernels, TheSideHitIsTheOneThatFacesTheRay) {
  const Directions directions = RandomDirections(10);
  const Directions normals = RandomDirections(20);
  RayPacket packet = Hits({0, 0, 0}, directions, normals, AllLanes(1.0f));
  packet.hit.primID[3] = RTC_INVALID_GEOMETRY_ID;
  packet.hit.primID[4] = RTC_INVALID_GEOMETRY_ID;
  // See SetRays: a ray upwards that hits nothing meets the sky, one downwards the ground.
  for (const int lane : {3, 4}) {
    packet.hit.Ng_x[lane] = packet.hit.Ng_z[lane] = 0.0f;
    packet.hit.Ng_y[lane] = -1.0f;
    packet.ray.dir_y[lane] = lane == 3 ? 0.5f : -0.5f;
  }
  const Lanes<uint32_t> side = SidesHit(packet, 5);
  for (int i = 0; i < kLanes; ++i) {
    if (i == 3 || i == 4) continue;
    const bool front = Of(directions, i).dot(Of(normals, i)) < 0.0;
    EXPECT_EQ(side[i], SideIndex(static_cast<size_t>(i % 5), front)) << i;
  }
  EXPECT_EQ(side[3], SideIndex(5, true));
  EXPECT_EQ(side[4], SideIndex(5, false));
}

TEST(LaneKernels, APixelIsAsWideAsItsRayIsLongAndAsItsSurfaceLeans) {
  const Directions directions = RandomDirections(50);
  const Directions normals = RandomDirections(60);
  const Lanes<float> t = RandomLanes(70, 1.0, 5.0);
  const Lanes<float> before = RandomLanes(80, 0.0, 2.0);
  const RayPacket packet = Hits({0, 0, 0}, directions, normals, t);
  const Lanes<float> widths = PixelWidths(packet, before, 0.002f);
  for (int i = 0; i < kLanes; ++i) {
    const double cosine = std::abs(Of(directions, i).normalized().dot(Of(normals, i).normalized()));
    const double expected = 0.002 * (before[i] + t[i]) / std::sqrt(std::max(0.01, cosine));
    EXPECT_NEAR(widths[i], expected, 1e-4 * expected) << i;
  }
}

TEST(LaneKernels, LanesLookUpOnTheirOwn) {
  std::vector<uint32_t> table;
  for (uint32_t i = 0; i < 40; ++i) table.push_back(Hashed(i));
  Lanes<uint32_t> index;
  for (uint32_t i = 0; i < kLanes; ++i) index.v[i] = (7 * i) % 40;
  const Lanes<uint32_t> found = LookUp(table.data(), index);
  for (int i = 0; i < kLanes; ++i) EXPECT_EQ(found[i], table[index[i]]);
}

}  // namespace
}  // namespace fenestra
