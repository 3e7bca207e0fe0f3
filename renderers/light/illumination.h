#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "renderers/light/diffuse_light.h"

namespace fenestra {

/// The diffuse light of a scene under any lighting. The effect of a unit of each light is computed
/// at its first use and kept, so that a lighting that only dims known lights costs nothing, and
/// another position of the sun a few milliseconds. Thread-safe; results do not depend on earlier
/// calls.
class Illumination {
 public:
  /// Keeps references to the arguments.
  Illumination(const Scene& scene, const TracedScene& traced, const LightBake& bake, int bounces);

  /// The irradiance of the bake's points, without light that comes straight from sun and lamps.
  std::vector<Spectrum> Ambient(const Lighting& lighting) const;

 private:
  using Solution = std::shared_ptr<const DiffuseLight::PointIrradiances>;

  // Everything that a unit solution depends on besides the scene.
  struct Key {
    enum class Light { kSky, kGround, kSun, kLamps, kEmission };
    Light light;
    Sky::Model model = Sky::Model::kUniform;
    double azimuth_rad = 0.0;
    double elevation_rad = 0.0;
    bool operator==(const Key&) const = default;
  };

  Solution Find(const Key& key) const;
  DiffuseLight::PointIrradiances Solve(const Key& key) const;

  const LightBake& bake_;
  DiffuseLight light_;
  bool has_lamps_;
  bool has_emission_;
  mutable std::mutex mutex_;
  mutable std::vector<std::pair<Key, Solution>> known_;  // In the order of their last use.
};

}  // namespace fenestra
