#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>
#include <set>

#include "core/io/input_error.h"
#include "scenes/facade/facade_check.h"
#include "scenes/facade/facade_parts.h"
#include "scenes/facade/facade_plan.h"
#include "tests/scenes/facade/facade_examples.h"
#include "tests/scenes/mesh_checks.h"

namespace fenestra {
namespace {

bool SamePositions(const Mesh& a, const Mesh& b) {
  return a.positions_W == b.positions_W && a.triangles == b.triangles;
}

struct Bounds {
  glm::vec3 low{std::numeric_limits<float>::infinity()};
  glm::vec3 high{-std::numeric_limits<float>::infinity()};
};

Bounds BoundsOf(const Mesh& mesh) {
  Bounds bounds;
  for (const glm::vec3& p : mesh.positions_W) {
    bounds.low = glm::min(bounds.low, p);
    bounds.high = glm::max(bounds.high, p);
  }
  return bounds;
}

// Whether any triangle's extent along the wall reaches into the frame's front rectangle.
bool StandsBefore(const Mesh& mesh, double width_m, double height_m) {
  constexpr float kTouching_m = 1e-6f;
  const auto x = static_cast<float>(0.5 * width_m) - kTouching_m;
  const auto y = static_cast<float>(0.5 * height_m) - kTouching_m;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions_W[t.x];
    const glm::vec3 b = mesh.positions_W[t.y];
    const glm::vec3 c = mesh.positions_W[t.z];
    const glm::vec3 low = glm::min(a, glm::min(b, c));
    const glm::vec3 high = glm::max(a, glm::max(b, c));
    if (low.x < x && high.x > -x && low.y < y && high.y > -y) return true;
  }
  return false;
}

TEST(FacadeParts, LeaveTheTargetsTruthBitForBit) {
  FacadeOptions plain;
  plain.window.setback_m = 0.1;
  const Scene alone = MakeFacade(plain);
  FacadeOptions covered = CoveredFacade();
  covered.wall.paint.reflectance = 0.5;
  covered.wall.paint.reflectance_830nm = 0.5;
  covered.wall.texture_contrast = 0.2;
  const Scene scene = MakeFacade(covered);
  EXPECT_NO_THROW(Validate(scene));
  ASSERT_TRUE(scene.target && alone.target);
  EXPECT_EQ(scene.target->Corners_W(), alone.target->Corners_W());
  EXPECT_EQ(scene.target->Centroid_W(), Eigen::Vector3d(0.0, 0.0, -0.1));
  EXPECT_EQ(scene.target->width_m, alone.target->width_m);
  EXPECT_EQ(scene.target->height_m, alone.target->height_m);
}

TEST(FacadeParts, ThatSayTheyAreClosedAre) {
  FacadeOptions o = CoveredFacade();
  for (const bool outside : {false, true}) {
    o.blind.outside = outside;
    o.blind.slatted = !outside;
    o.shutters.louvred = outside;
    const Scene scene = MakeFacade(o);
    const std::set<std::string> of_lattice = {"wall",   "frame",       "room",      "sill",
                                              "lintel", "other frame", "other room"};
    for (const Mesh& mesh : scene.meshes) {
      if (!mesh.closed || of_lattice.contains(mesh.name)) continue;
      EXPECT_TRUE(IsWatertight(mesh)) << mesh.name;
      EXPECT_GT(EnclosedVolume(mesh), 0.0) << mesh.name;
    }
  }
}

TEST(FacadeParts, BesideTheWindowStandNowhereBeforeItsFrame) {
  const Scene scene = MakeFacade(StreetFacade());
  for (const char* name : {"sill", "lintel", "shutters", "drainpipe"}) {
    ASSERT_NE(Find(scene, name), nullptr) << name;
    EXPECT_FALSE(StandsBefore(*Find(scene, name), 1.0, 1.0)) << name;
  }
  // The twin: what covers the window is found to do so.
  const Scene covered = MakeFacade(CoveredFacade());
  for (const char* name : {"railing", "cables", "plant", "blind"}) {
    EXPECT_TRUE(StandsBefore(*Find(covered, name), 1.0, 1.0)) << name;
  }
}

// What is switched on draws from a stream of its own: everything else stays where it is.
TEST(FacadeParts, DoNotChangeEachOther) {
  const FacadeOptions all = CoveredFacade();
  const Scene full = MakeFacade(all);
  const auto expect_rest = [&](const FacadeOptions& less, const char* left_out) {
    const Scene scene = MakeFacade(less);
    EXPECT_EQ(Find(scene, left_out), nullptr);
    for (const char* name : {"shutters", "drainpipe", "cables", "railing", "blind", "other blinds",
                             "plant", "other panes"}) {
      if (std::string(name) == left_out || std::string(name) == "other blinds") continue;
      ASSERT_NE(Find(scene, name), nullptr) << name << " without " << left_out;
      EXPECT_TRUE(SamePositions(*Find(scene, name), *Find(full, name)))
          << name << " without " << left_out;
    }
  };
  FacadeOptions less = all;
  less.cables.count = 0;
  expect_rest(less, "cables");
  less = all;
  less.plant.coverage = 0.0;
  expect_rest(less, "plant");
  less = all;
  less.blind.coverage = 0.0;
  expect_rest(less, "blind");
  less = all;
  less.shutters.present = false;
  expect_rest(less, "shutters");
}

TEST(FacadeParts, AreFunctionsOfTheSeed) {
  FacadeOptions o = CoveredFacade();
  const Scene one = MakeFacade(o);
  const Scene again = MakeFacade(o);
  o.seed = 2.5;
  const Scene other = MakeFacade(o);
  for (const char* name : {"cables", "plant", "other blinds"}) {
    EXPECT_TRUE(SamePositions(*Find(one, name), *Find(again, name))) << name;
    EXPECT_FALSE(SamePositions(*Find(one, name), *Find(other, name))) << name;
  }
}

TEST(FacadeParts, EachHaveReflectancesOfTheirOwn) {
  FacadeOptions o = CoveredFacade();
  const Scene scene = MakeFacade(o);
  std::set<uint32_t> materials;
  for (const Mesh& mesh : scene.meshes) {
    EXPECT_TRUE(materials.insert(mesh.material).second) << mesh.name;
    EXPECT_EQ(scene.materials[mesh.material].name, mesh.name);
  }
}

TEST(Blind, HangsFromTheTopByItsCoverage) {
  FacadeOptions o;
  o.window.setback_m = 0.1;
  o.blind.coverage = 0.3;
  for (const bool slatted : {false, true}) {
    o.blind.slatted = slatted;
    o.blind.outside = true;
    const Bounds outside = BoundsOf(*Find(MakeFacade(o), "blind"));
    EXPECT_NEAR(outside.low.y, 0.5 - 0.3 * 1.0, 1e-6);
    EXPECT_NEAR(outside.high.y, 0.5, 1e-6);
    EXPECT_NEAR(outside.low.x, -0.495, 1e-6);
    EXPECT_GT(outside.low.z, -0.1f);  // Before the frame.
    o.blind.outside = false;
    const Bounds inside = BoundsOf(*Find(MakeFacade(o), "blind"));
    EXPECT_NEAR(inside.low.y, 0.4 - 0.3 * 0.8, 1e-6);
    EXPECT_LT(inside.high.z, -0.16f);  // Behind it.
  }
}

TEST(Shutters, NeedRoomBesideTheWindow) {
  FacadeOptions o = StreetFacade();
  o.grid.gap_x_m = 2.0 * ShutterReach_m(1.0) + 0.01;
  o.drainpipe.present = false;
  EXPECT_NO_THROW(MakeFacade(o));
  o.grid.gap_x_m = 2.0 * ShutterReach_m(1.0) - 0.01;
  EXPECT_THROW(MakeFacade(o), InputError);
}

TEST(Cables, HangLowestInTheMiddleAtTheGivenHeight) {
  FacadeOptions o;
  o.cables = {.count = 1, .height_m = 0.2, .distance_m = 0.3, .radius_m = 0.01, .sag_m = 0.5};
  const Bounds cable = BoundsOf(*Find(MakeFacade(o), "cables"));
  EXPECT_NEAR(cable.low.y, 0.2 - 0.01, 2e-3);  // A prism's lowest point, up to r (1 - cos(π/6)).
  EXPECT_GE(cable.high.y, 0.2 + 0.7 * 0.5);
  EXPECT_LE(cable.high.y, 0.2 + 1.3 * 0.5 + 0.01);
  EXPECT_LE(cable.high.z, 0.31f + 1e-6f);
  EXPECT_GT(cable.low.z, 0.28f);
}

// I(θ) as lamp.h has it, integrated over the half space below.
TEST(RoomLamp, GivesItsLuminousFluxInItsOwnRoom) {
  FacadeOptions o = StreetFacade();
  o.room.lamp_lm = 2000.0;
  o.room.other_lamps_lm = 500.0;
  const Scene scene = MakeFacade(o);
  ASSERT_EQ(scene.lamps.size(), 9u);
  const FacadePlan plan = PlanFacade(o, RandomStream(1));
  for (size_t i = 0; i < scene.lamps.size(); ++i) {
    const Lamp& lamp = scene.lamps[i];
    ASSERT_TRUE(lamp.cone);
    const double c_inner = std::cos(lamp.cone->inner_rad);
    const double c_outer = std::cos(lamp.cone->outer_rad);
    double flux = 0.0;
    constexpr int kSteps = 2000;
    for (int k = 0; k < kSteps; ++k) {
      const double theta = std::numbers::pi * (k + 0.5) / kSteps;
      const double share = std::clamp((std::cos(theta) - c_outer) / (c_inner - c_outer), 0.0, 1.0);
      flux += static_cast<double>(lamp.intensity_rgb.g) * share * share * 2.0 * std::numbers::pi *
              std::sin(theta) * std::numbers::pi / kSteps;
    }
    EXPECT_NEAR(flux, i == 0 ? 2000.0 : 500.0, 0.01);  // The midpoint rule's 1e-6.
    const Box& room = plan.windows[i].room;
    EXPECT_TRUE((lamp.p_WL.array() > room.low.array()).all() &&
                (lamp.p_WL.array() < room.high.array()).all());
  }
}

}  // namespace
}  // namespace fenestra
