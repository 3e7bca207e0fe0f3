#include "scenes/facade.h"

#include <algorithm>
#include <cmath>

#include "scenes/size_checks.h"
#include "scenes/solid_lattice.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

constexpr SolidLattice::Solid kWall = 1;
constexpr SolidLattice::Solid kFrame = 2;
constexpr SolidLattice::Solid kRoom = 3;

// The room: a sill at the usual 0.9 m above the floor, a lintel, and space to both sides, as far as
// the wall is large enough. Behind its surfaces is at least this much masonry.
constexpr double kSill_m = 0.9;
constexpr double kLintel_m = 0.6;
constexpr double kBeside_m = 1.5;
constexpr double kMasonry_m = 0.1;
// The pane stands this deep in the frame, so that no light passes at its edge.
constexpr double kRebate_m = 0.005;

// Light varies fastest where reveal, frame and wall meet. Cells of at most 5 cm there, growing with
// the distance, keep the error of linear interpolation about that of the baked light itself.
constexpr double kFinestCell_m = 0.05;
constexpr double kCellGrowth = 0.5;
constexpr double kLargestCell_m = 1.0;

double CellSize(double distance_m) {
  return std::min(kFinestCell_m + kCellGrowth * distance_m, kLargestCell_m);
}

void Check(const FacadeOptions& o) {
  SizeChecks checks("facade");
  checks.Positive("width_m", o.width_m);
  checks.Positive("height_m", o.height_m);
  checks.Positive("frame_width_m", o.frame_width_m);
  checks.Positive("frame_depth_m", o.frame_depth_m);
  checks.Positive("wall_thickness_m", o.wall_thickness_m);
  checks.Positive("room_depth_m", o.room_depth_m);
  checks.Positive("wall_width_m", o.wall_width_m);
  checks.Positive("wall_height_m", o.wall_height_m);
  checks.Demand(std::isfinite(o.frame_setback_m) && o.frame_setback_m >= 0.0,
                fmt::format("frame_setback_m must be 0 or more, not {}", o.frame_setback_m));
  checks.Demand(!(2.0 * o.frame_width_m >= std::min(o.width_m, o.height_m)),
                fmt::format("two sides of a frame of {} m do not fit into {} m x {} m",
                            o.frame_width_m, o.width_m, o.height_m));
  checks.Demand(!(o.frame_setback_m + o.frame_depth_m > o.wall_thickness_m),
                fmt::format("a frame {} m deep, set back by {} m, does not fit into a wall of {} m",
                            o.frame_depth_m, o.frame_setback_m, o.wall_thickness_m));
  checks.Demand(!(o.width_m + 2.0 * kMasonry_m > o.wall_width_m ||
                  o.height_m + 2.0 * kMasonry_m > o.wall_height_m),
                fmt::format("a window of {} m x {} m needs {} m of wall around it, but the wall is "
                            "{} m x {} m",
                            o.width_m, o.height_m, kMasonry_m, o.wall_width_m, o.wall_height_m));
  checks.Reflectance("wall_reflectance", o.wall_reflectance);
  checks.Reflectance("wall_reflectance_830nm", o.wall_reflectance_830nm);
  checks.Reflectance("frame_reflectance", o.frame_reflectance);
  checks.Reflectance("frame_reflectance_830nm", o.frame_reflectance_830nm);
  checks.Reflectance("room_reflectance", o.room_reflectance);
  checks.Reflectance("room_reflectance_830nm", o.room_reflectance_830nm);
  checks.ThrowIfFaulty();
}

// All boxes of the building. z = 0 is the wall's outer face.
struct Plan {
  Box building;
  Box room;
  Box room_shell;
  Box opening;
  Box frame;
  Box frame_hole;
};

Plan MakePlan(const FacadeOptions& o) {
  const double x = 0.5 * o.width_m;
  const double y = 0.5 * o.height_m;
  const double room_x = std::min(x + kBeside_m, 0.5 * o.wall_width_m - kMasonry_m);
  const double floor_y = std::max(-y - kSill_m, -0.5 * o.wall_height_m + kMasonry_m);
  const double ceiling_y = std::min(y + kLintel_m, 0.5 * o.wall_height_m - kMasonry_m);
  const double room_front_z = -o.wall_thickness_m;
  const double room_back_z = room_front_z - o.room_depth_m;
  const double frame_front_z = -o.frame_setback_m;
  const double frame_back_z = frame_front_z - o.frame_depth_m;
  const Vector3d masonry = Vector3d::Constant(kMasonry_m);
  Plan plan;
  plan.room = {{-room_x, floor_y, room_back_z}, {room_x, ceiling_y, room_front_z}};
  plan.room_shell = {plan.room.low - masonry,
                     {room_x + kMasonry_m, ceiling_y + kMasonry_m, room_front_z}};
  plan.building = {{-0.5 * o.wall_width_m, -0.5 * o.wall_height_m, room_back_z - kMasonry_m},
                   {0.5 * o.wall_width_m, 0.5 * o.wall_height_m, 0.0}};
  plan.opening = {{-x, -y, room_front_z}, {x, y, 0.0}};
  plan.frame = {{-x, -y, frame_back_z}, {x, y, frame_front_z}};
  const Vector3d bar(o.frame_width_m, o.frame_width_m, 0.0);
  plan.frame_hole = {plan.frame.low + bar, plan.frame.high - bar};
  return plan;
}

SolidLattice MakeLattice(const Plan& plan) {
  std::array<std::vector<float>, 3> breaks;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> fixed;
    for (const Box& box :
         {plan.building, plan.room, plan.room_shell, plan.opening, plan.frame, plan.frame_hole}) {
      fixed.push_back(box.low[axis]);
      fixed.push_back(box.high[axis]);
    }
    const double low = plan.opening.low[axis];
    const double high = plan.opening.high[axis];
    const auto cell_size = [low, high, axis](double at) {
      // Along x and y the light changes at the opening's edges; along z in all of its depth.
      const double outside = std::max(low - at, at - high);
      return CellSize(axis == 2 ? std::max(outside, 0.0) : std::abs(outside));
    };
    breaks[static_cast<size_t>(axis)] = GradedBreaks(fixed, cell_size);
  }
  return SolidLattice(std::move(breaks));
}

Mesh MakePane(const FacadeOptions& o, uint32_t material) {
  const auto x = static_cast<float>(0.5 * o.width_m - o.frame_width_m + kRebate_m);
  const auto y = static_cast<float>(0.5 * o.height_m - o.frame_width_m + kRebate_m);
  const auto z = static_cast<float>(-o.frame_setback_m - 0.5 * o.frame_depth_m);
  return {.name = "pane",
          .positions_W = {{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .material = material};
}

Material Paint(const char* name, double reflectance, double reflectance_830nm) {
  return {.name = name,
          .reflectance_rgb = glm::vec3(static_cast<float>(reflectance)),
          .reflectance_830nm = static_cast<float>(reflectance_830nm)};
}

}  // namespace

Scene MakeFacade(const FacadeOptions& options) {
  Check(options);
  const FacadeOptions& o = options;
  const Plan plan = MakePlan(o);
  SolidLattice lattice = MakeLattice(plan);
  lattice.Fill(plan.building, kWall);
  // Nobody who sees the facade's front sees the building's other outer faces.
  constexpr auto kSeen = SolidLattice::Faces::kFrontOfLattice;
  Scene scene;
  scene.materials.push_back(Paint("wall", o.wall_reflectance, o.wall_reflectance_830nm));
  if (!o.with_target) {
    scene.meshes.push_back(lattice.Surface(kWall, kSeen, "wall", 0));
    return scene;
  }
  lattice.Fill(plan.room_shell, kRoom);
  lattice.Fill(plan.room, SolidLattice::kAir);
  lattice.Fill(plan.opening, SolidLattice::kAir);
  lattice.Fill(plan.frame, kFrame);
  lattice.Fill(plan.frame_hole, SolidLattice::kAir);

  scene.materials.push_back(Paint("frame", o.frame_reflectance, o.frame_reflectance_830nm));
  scene.materials.push_back(Paint("room", o.room_reflectance, o.room_reflectance_830nm));
  scene.meshes.push_back(lattice.Surface(kWall, kSeen, "wall", 0));
  scene.meshes.push_back(lattice.Surface(kFrame, kSeen, "frame", 1));
  scene.meshes.push_back(lattice.Surface(kRoom, kSeen, "room", 2));
  if (o.glass) {
    scene.materials.push_back({.name = "glass", .kind = Material::Kind::kGlass});
    scene.meshes.push_back(MakePane(o, 3));
  }
  scene.target = {.X_WO = Pose::Translation({0.0, 0.0, -o.frame_setback_m}),
                  .width_m = o.width_m,
                  .height_m = o.height_m};
  return scene;
}

}  // namespace fenestra
