#include "renderers/light/illumination.h"

#include <algorithm>

#include "renderers/light/spectrum.h"

namespace fenestra {
namespace {

// Enough for a sweep over a day in which trials on several threads take turns; a solution of a
// facade takes some 100 kB.
constexpr size_t kMostKnown = 32;

void AddScaled(const std::vector<Spectrum>& unit, const Spectrum& scale,
               std::vector<Spectrum>& sum) {
  for (size_t i = 0; i < sum.size(); ++i) sum[i] += scale * unit[i];
}

bool Emits(const Material& material) {
  return material.emission_rgb != glm::vec3(0.0f) || material.emission_830nm > 0.0f;
}

}  // namespace

Illumination::Illumination(const Scene& scene, const TracedScene& traced, const LightBake& bake,
                           int bounces)
    : bake_(bake),
      light_(scene, traced, bake, bounces),
      has_lamps_(!scene.lamps.empty()),
      has_emission_(std::ranges::any_of(scene.materials, Emits)) {}

DiffuseLight::PointIrradiances Illumination::Solve(const Key& key) const {
  const Sun sun{.azimuth_rad = key.azimuth_rad, .elevation_rad = key.elevation_rad};
  switch (key.light) {
    case Key::Light::kSky:
      return light_.FromSky(SkyDome(key.model, sun.Direction_W()));
    case Key::Light::kGround:
      return light_.FromGround();
    case Key::Light::kSun: {
      const Eigen::Vector3f to_sun = sun.Direction_W().cast<float>();
      return light_.FromSun({to_sun.x(), to_sun.y(), to_sun.z()});
    }
    case Key::Light::kLamps:
      return light_.FromLamps();
    case Key::Light::kEmission:
      break;
  }
  return light_.FromEmission();
}

Illumination::Solution Illumination::Find(const Key& key) const {
  {
    const std::scoped_lock lock(mutex_);
    const auto found = std::ranges::find(known_, key, &std::pair<Key, Solution>::first);
    if (found != known_.end()) {
      std::rotate(found, found + 1, known_.end());
      return known_.back().second;
    }
  }
  // Outside the lock: two threads may solve the same at once, and find the same.
  Solution solution = std::make_shared<DiffuseLight::PointIrradiances>(Solve(key));
  const std::scoped_lock lock(mutex_);
  if (known_.size() >= kMostKnown) known_.erase(known_.begin());
  known_.emplace_back(key, solution);
  return solution;
}

std::vector<Spectrum> Illumination::Ambient(const Lighting& lighting) const {
  std::vector<Spectrum> ambient(bake_.point_count(), Spectrum(0.0f));
  const double azimuth = lighting.sun.azimuth_rad;
  const double elevation = lighting.sun.elevation_rad;
  if (lighting.sky.illuminance_lx > 0.0) {
    Key key{.light = Key::Light::kSky, .model = lighting.sky.model};
    if (lighting.sky.model == Sky::Model::kCieClear) {
      key.azimuth_rad = azimuth;
      key.elevation_rad = elevation;
    }
    AddScaled(*Find(key), DaylightSpectrum(lighting.sky.illuminance_lx, lighting), ambient);
  }
  const Spectrum ground = GroundExitance(lighting);
  if (ground.x > 0.0f) AddScaled(*Find({.light = Key::Light::kGround}), ground, ambient);
  const double sun = SunIlluminance(lighting);
  if (sun > 0.0) {
    const Key key{.light = Key::Light::kSun, .azimuth_rad = azimuth, .elevation_rad = elevation};
    AddScaled(*Find(key), DaylightSpectrum(sun, lighting), ambient);
  }
  if (has_lamps_ && lighting.lamp_dimmer > 0.0) {
    AddScaled(*Find({.light = Key::Light::kLamps}),
              Spectrum(static_cast<float>(lighting.lamp_dimmer)), ambient);
  }
  if (has_emission_) {
    AddScaled(*Find({.light = Key::Light::kEmission}), Spectrum(1.0f), ambient);
  }
  return ambient;
}

}  // namespace fenestra
