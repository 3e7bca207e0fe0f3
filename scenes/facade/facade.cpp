#include "scenes/facade/facade.h"

#include <algorithm>
#include <bit>
#include <numbers>
#include <utility>

#include "scenes/facade/facade_check.h"
#include "scenes/facade/facade_parts.h"
#include "scenes/facade/facade_plan.h"
#include "scenes/facade/facade_plant.h"
#include "scenes/facade/masonry.h"
#include "scenes/facade/wall_texture.h"

namespace fenestra {
namespace {

constexpr double kLampBelowCeiling_m = 0.2;

// Puts a facade together, mesh by mesh.
class FacadeBuilder {
 public:
  FacadeBuilder(const FacadeOptions& options, const FacadePlan& plan, const RandomStream& random)
      : options_(options), plan_(plan), random_(random) {}

  Scene Build() {
    AddMasonry();
    if (options_.window.glass) AddGlass();
    AddBeforeWall();
    AddBlinds();
    if (Target() != nullptr && options_.plant.coverage > 0.0) {
      Add(MakePlant(options_, *Target(), random_.Child("plant"), 0), options_.plant.paint);
    }
    for (const WindowPlan& window : plan_.windows) AddWindow(window);
    return std::move(scene_);
  }

 private:
  const WindowPlan* Target() const {
    return options_.with_target ? &plan_.windows.front() : nullptr;
  }

  void Add(Mesh mesh, Material material) {
    if (mesh.triangles.empty()) return;
    mesh.material = static_cast<uint32_t>(scene_.materials.size());
    material.name = mesh.name;
    scene_.materials.push_back(std::move(material));
    scene_.meshes.push_back(std::move(mesh));
  }

  void Add(Mesh mesh, const Paint& paint) {
    const Material material = MaterialOf(mesh.name, paint);
    Add(std::move(mesh), material);
  }

  void AddMasonry() {
    const SolidSurface surface = BuildMasonry(options_, plan_);
    AddWall(MeshOf(surface, kWallSolid, "wall", 0));
    const auto add = [&](Solid solid, const char* name, const Paint& paint) {
      Add(MeshOf(surface, solid, name, 0), paint);
    };
    add(kFrameSolid, "frame", options_.window.frame);
    add(kRoomSolid, "room", options_.room.paint);
    add(kSillSolid, "sill", options_.sill.paint);
    add(kLintelSolid, "lintel", options_.lintel.paint);
    add(kOtherFrameSolid, "other frame", options_.grid.other_frame);
    add(kOtherRoomSolid, "other room", options_.room.paint);
  }

  void AddWall(Mesh wall) {
    if (options_.wall.texture_contrast == 0.0) {
      Add(std::move(wall), options_.wall.paint);
      return;
    }
    const RandomStream random = random_.Child("wall");
    TexturedWall textured = MakeTexturedWall(options_.wall, random);
    const RandomStream shift = random.Child("shift");
    LayTexture(textured.side_m, {shift.Uniform(0), shift.Uniform(1)}, wall);
    scene_.textures.push_back(std::move(textured.texture));
    Add(std::move(wall), textured.material);
  }

  void AddGlass() {
    Mesh pane{.name = "pane"};
    Mesh others{.name = "other panes"};
    for (const WindowPlan& window : plan_.windows) {
      AddPanes(options_.window, window, window.is_target ? pane : others);
    }
    const Material glass{.name = "glass", .kind = Material::Kind::kGlass};
    Add(std::move(pane), glass);
    Add(std::move(others), glass);
  }

  void AddBeforeWall() {
    const FacadeOptions& o = options_;
    if (o.shutters.present) Add(MakeShutters(o, plan_, 0), o.shutters.paint);
    if (o.drainpipe.present) Add(MakeDrainpipe(o, 0), o.drainpipe.paint);
    if (o.cables.count > 0) Add(MakeCables(o, random_.Child("cables"), 0), o.cables.paint);
    if (o.railing.present && Target() != nullptr) {
      Add(MakeRailing(o, *Target(), 0), o.railing.paint);
    }
  }

  void AddBlinds() {
    if (options_.blind.coverage == 0.0) return;
    Mesh blind{.name = "blind", .closed = true};
    Mesh others{.name = "other blinds", .closed = true};
    for (const WindowPlan& window : plan_.windows) {
      const double coverage =
          window.is_target ? options_.blind.coverage : window.random.Child("blind").Uniform(0);
      AddBlind(options_, window, coverage, window.is_target ? blind : others);
    }
    Add(std::move(blind), options_.blind.paint);
    Add(std::move(others), options_.blind.paint);
  }

  void AddWindow(const WindowPlan& window) {
    const TargetWindow truth{.X_WO = Pose::Translation(window.p_WO),
                             .width_m = options_.window.width_m,
                             .height_m = options_.window.height_m};
    if (window.is_target) {
      scene_.target = truth;
    } else {
      scene_.other_windows.push_back(truth);
    }
    const RoomOptions& room = options_.room;
    const double flux_lm = window.is_target ? room.lamp_lm : room.other_lamps_lm;
    if (flux_lm > 0.0) scene_.lamps.push_back(LampOf(window.room, flux_lm));
  }

  // A flat ceiling lamp: in a cone as wide as the half space below, I(θ) = I cos² θ, whose flux is
  // Φ = 2π ∫ I cos² θ sin θ dθ = 2π I / 3.
  Lamp LampOf(const Box& room, double flux_lm) const {
    const Eigen::Vector3d centre = 0.5 * (room.low + room.high);
    const double drop_m = std::min(kLampBelowCeiling_m, 0.1 * (room.high.y() - room.low.y()));
    const double intensity_cd = 1.5 * flux_lm / std::numbers::pi;
    return {.name = "ceiling lamp",
            .p_WL = {centre.x(), room.high.y() - drop_m, centre.z()},
            .intensity_rgb = glm::vec3(static_cast<float>(intensity_cd)),
            .irradiance_830_per_lux = options_.room.lamp_irradiance_830_per_lux,
            .cone = Lamp::Cone{.axis_W = -Eigen::Vector3d::UnitY(),
                               .inner_rad = 0.0,
                               .outer_rad = 0.5 * std::numbers::pi}};
  }

  const FacadeOptions& options_;
  const FacadePlan& plan_;
  RandomStream random_;
  Scene scene_;
};

}  // namespace

Scene MakeFacade(const FacadeOptions& options) {
  Validate(options);
  const RandomStream random(std::bit_cast<uint64_t>(options.seed));
  const FacadePlan plan = PlanFacade(options, random);
  return FacadeBuilder(options, plan, random).Build();
}

}  // namespace fenestra
