#include "scenes/targets/paper_target.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/faults.h"
#include "scenes/mesh/solid_lattice.h"
#include "scenes/paint.h"

namespace fenestra {
namespace {

constexpr Solid kWall = 1;
constexpr Solid kBorder = 2;

// Only the front of this plate becomes surface.
constexpr double kPlate_m = 1.0;

void Check(const PaperTargetOptions& o) {
  Faults faults("paper_target");
  faults.RequirePositive("width_m", o.width_m);
  faults.RequirePositive("height_m", o.height_m);
  faults.RequirePositive("border_m", o.border_m);
  faults.RequirePositive("wall_width_m", o.wall_width_m);
  faults.RequirePositive("wall_height_m", o.wall_height_m);
  faults.Require(!(2.0 * o.border_m >= std::min(o.width_m, o.height_m)),
                 fmt::format("two borders of {} m do not fit into {} m x {} m", o.border_m,
                             o.width_m, o.height_m));
  faults.Require(!(o.width_m >= o.wall_width_m || o.height_m >= o.wall_height_m),
                 fmt::format("a target of {} m x {} m does not fit on a wall of {} m x {} m",
                             o.width_m, o.height_m, o.wall_width_m, o.wall_height_m));
  faults.RequireWithin("wall_reflectance", o.wall_reflectance, 0.0, 1.0);
  faults.RequireWithin("wall_reflectance_830nm", o.wall_reflectance_830nm, 0.0, 1.0);
  faults.RequireWithin("frame_reflectance", o.frame_reflectance, 0.0, 1.0);
  faults.RequireWithin("frame_reflectance_830nm", o.frame_reflectance_830nm, 0.0, 1.0);
  faults.ThrowIfAny();
}

// An upright rectangle of the plate, centred on the origin.
Box Plate(double width_m, double height_m) {
  return {{-0.5 * width_m, -0.5 * height_m, -kPlate_m}, {0.5 * width_m, 0.5 * height_m, 0.0}};
}

std::vector<float> Breaks(double wall_m, double target_m, double border_m) {
  const double inner_m = 0.5 * target_m - border_m;
  // Nothing stands before the plane, so that its sky light is uniform and large cells suffice.
  return DistinctBreaks(
      {-0.5 * wall_m, -0.5 * target_m, -inner_m, inner_m, 0.5 * target_m, 0.5 * wall_m});
}

}  // namespace

Scene MakePaperTarget(const PaperTargetOptions& options) {
  Check(options);
  const PaperTargetOptions& o = options;
  SolidLattice lattice({Breaks(o.wall_width_m, o.width_m, o.border_m),
                        Breaks(o.wall_height_m, o.height_m, o.border_m),
                        {static_cast<float>(-kPlate_m), 0.0f}});
  lattice.Fill(Plate(o.wall_width_m, o.wall_height_m), kWall);

  Scene scene;
  scene.materials.push_back(MaterialOf("wall", {o.wall_reflectance, o.wall_reflectance_830nm}));
  if (o.with_target) {
    lattice.Fill(Plate(o.width_m, o.height_m), kBorder);
    lattice.Fill(Plate(o.width_m - 2.0 * o.border_m, o.height_m - 2.0 * o.border_m), kWall);
    scene.materials.push_back(
        MaterialOf("border", {o.frame_reflectance, o.frame_reflectance_830nm}));
    scene.target = {.X_WO = Pose(), .width_m = o.width_m, .height_m = o.height_m};
  }
  const SolidSurface surface = lattice.Surface(SolidLattice::Faces::kFrontOfLattice);
  scene.meshes.push_back(MeshOf(surface, kWall, "wall", 0));
  if (o.with_target) scene.meshes.push_back(MeshOf(surface, kBorder, "border", 1));
  return scene;
}

}  // namespace fenestra
