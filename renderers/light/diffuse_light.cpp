#include "renderers/light/diffuse_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace fenestra {
namespace {

using glm::vec3;

// Changes below this part of the largest irradiance are invisible: a sensor's noise is a hundred
// times larger.
constexpr float kSettled = 1e-5f;

vec3 ToVec3(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void Aim(RTCRay16& rays, int lane, const vec3& direction, float tfar) {
  rays.dir_x[lane] = direction.x;
  rays.dir_y[lane] = direction.y;
  rays.dir_z[lane] = direction.z;
  rays.tfar[lane] = tfar;
}

float Mean(const Lanes<float>& values, int count) {
  float sum = 0.0f;
  for (int i = 0; i < count; ++i) sum += values[i];
  return sum / static_cast<float>(count);
}

}  // namespace

float LampIrradiance(const Lamp& lamp, const glm::vec3& p_W, const glm::vec3& n_W) {
  const vec3 to_lamp = ToVec3(lamp.p_WL) - p_W;
  const float rr = glm::dot(to_lamp, to_lamp);
  const float along_n = glm::dot(to_lamp, n_W);
  if (!(along_n > 0.0f)) return 0.0f;
  const float r = std::sqrt(rr);
  float E = along_n / (rr * r);
  if (lamp.cone) {
    const float c = -glm::dot(to_lamp, ToVec3(lamp.cone->axis_W)) / r;
    const auto outer = static_cast<float>(std::cos(lamp.cone->outer_rad));
    const auto inner = static_cast<float>(std::cos(lamp.cone->inner_rad));
    const float rim = std::clamp((c - outer) / (inner - outer), 0.0f, 1.0f);
    E *= rim * rim;
  }
  return E;
}

DiffuseLight::DiffuseLight(const Scene& scene, const TracedScene& traced, const LightBake& bake,
                           int bounces)
    : scene_(scene), traced_(traced), bake_(bake), bounces_(bounces) {
  const TriangleSoup& soup = traced.opaque();
  for (size_t e = 0; e < bake.elements.size(); ++e) {
    const LightPatch& patch = bake.patches.PatchOfFace(bake.elements.FaceOf(e));
    const Material& material =
        scene.materials[scene.meshes[soup.mesh_of[patch.triangles.front()]].material];
    Spectrum pattern(0.0f);
    const auto samples = bake.elements.SamplesOf(e);
    for (const LightElements::Sample& sample : samples) {
      pattern += traced.patterns().has_pattern(sample.triangle)
                     ? PatternSpectrum(traced.patterns().Mean(sample.triangle))
                     : Spectrum(1.0f);
    }
    pattern *= 1.0f / static_cast<float>(samples.size());
    reflectances_.push_back(pattern * ReflectanceSpectrum(material));
    emissions_.push_back(std::numbers::pi_v<float> * pattern * EmissionSpectrum(material));
  }
}

// Rays from the samples of one element.
struct DiffuseLight::ElementRays {
  vec3 n_W{0.0f};
  int count = 0;
  RTCRay16 rays;
  std::array<vec3, kLanes> origins_W;
};

DiffuseLight::ElementRays DiffuseLight::RaysFrom(size_t element) const {
  const uint32_t face = bake_.elements.FaceOf(element);
  const LightPatch& patch = bake_.patches.PatchOfFace(face);
  const auto samples = bake_.elements.SamplesOf(element);
  const float offset_m = traced_.SurfaceOffset(vec3(0.0f));
  ElementRays out;
  out.n_W = LightPatches::IsFront(face) ? patch.n_W : -patch.n_W;
  out.count = static_cast<int>(samples.size());
  for (int i = 0; i < kLanes; ++i) {
    const auto& sample = samples[static_cast<size_t>(std::min(i, out.count - 1))];
    const vec3 p = patch.At(sample.st) + offset_m * out.n_W;
    out.origins_W[static_cast<size_t>(i)] = p;
    out.rays.org_x[i] = p.x;
    out.rays.org_y[i] = p.y;
    out.rays.org_z[i] = p.z;
    out.rays.tnear[i] = 0.0f;
    out.rays.time[i] = 0.0f;
    out.rays.mask[i] = ~0u;
    out.rays.id[i] = 0u;
    out.rays.flags[i] = 0u;
  }
  return out;
}

DiffuseLight::PointIrradiances DiffuseLight::Bounced(const PointIrradiances& open,
                                                     const std::vector<Spectrum>& M_0) const {
  PointIrradiances E = open;
  std::vector<Spectrum> M(M_0.size());
  bool settled = false;
  for (int bounce = 0; bounce < bounces_ && !settled; ++bounce) {
    float largest = 0.0f;
    float largest_change = 0.0f;
    for (size_t e = 0; e < M.size(); ++e) {
      Spectrum mean(0.0f);
      for (size_t i = bake_.first_mean[e]; i < bake_.first_mean[e + 1]; ++i) {
        mean += bake_.means[i].w * E[bake_.means[i].point];
      }
      M[e] = M_0[e] + reflectances_[e] * mean;
    }
    for (size_t p = 0; p < E.size(); ++p) {
      Spectrum sum = open[p];
      for (size_t i = bake_.first_factor[p]; i < bake_.first_factor[p + 1]; ++i) {
        sum += bake_.factors[i].w * M[bake_.factors[i].element];
      }
      const Spectrum change = glm::abs(sum - E[p]);
      largest = std::max({largest, sum.x, sum.y, sum.z, sum.w});
      largest_change = std::max({largest_change, change.x, change.y, change.z, change.w});
      E[p] = sum;
    }
    settled = largest_change <= kSettled * largest;
  }
  return E;
}

DiffuseLight::PointIrradiances DiffuseLight::FromSky(const SkyDome& dome) const {
  struct Linear {
    float at_0;
    vec3 gradient;
  };
  std::vector<Linear> of_patch;
  for (const PatchLuminance& patch : PatchLuminances(dome)) {
    of_patch.push_back({static_cast<float>(patch.mean - patch.gradient.dot(patch.centre)),
                        ToVec3(patch.gradient)});
  }
  std::vector<float> of_view;
  of_view.reserve(bake_.open_views.size());
  for (const OpenView& view : bake_.open_views) {
    float E = 0.0f;
    for (const SkyPart& part : view.sky) {
      const Linear& L = of_patch[part.patch];
      E += part.w * L.at_0 + glm::dot(part.sum_W, L.gradient);
    }
    of_view.push_back(E);
  }
  PointIrradiances open;
  open.reserve(bake_.point_count());
  for (const uint32_t view : bake_.open_view_of) open.emplace_back(of_view[view]);
  return Bounced(open, std::vector<Spectrum>(bake_.elements.size(), Spectrum(0.0f)));
}

DiffuseLight::PointIrradiances DiffuseLight::FromGround() const {
  PointIrradiances open;
  open.reserve(bake_.point_count());
  for (const uint32_t view : bake_.open_view_of) open.emplace_back(bake_.open_views[view].ground);
  return Bounced(open, std::vector<Spectrum>(bake_.elements.size(), Spectrum(0.0f)));
}

DiffuseLight::PointIrradiances DiffuseLight::FromSun(const glm::vec3& to_sun_W) const {
  std::vector<Spectrum> M_0(bake_.elements.size(), Spectrum(0.0f));
  for (size_t e = 0; e < M_0.size(); ++e) {
    ElementRays from = RaysFrom(e);
    const float cosine = glm::dot(from.n_W, to_sun_W);
    if (!(cosine > 0.0f)) continue;
    for (int i = 0; i < kLanes; ++i) {
      Aim(from.rays, i, to_sun_W, std::numeric_limits<float>::infinity());
    }
    const Lanes<float> visible =
        traced_.Transmittance(FirstLanes(from.count), from.rays, Coherence::kCoherent);
    M_0[e] = cosine * Mean(visible, from.count) * reflectances_[e];
  }
  return Bounced(PointIrradiances(bake_.point_count(), Spectrum(0.0f)), M_0);
}

DiffuseLight::PointIrradiances DiffuseLight::FromLamps() const {
  std::vector<Spectrum> M_0(bake_.elements.size(), Spectrum(0.0f));
  for (const Lamp& lamp : scene_.lamps) {
    const Spectrum intensity = IntensitySpectrum(lamp);
    const vec3 p_WL = ToVec3(lamp.p_WL);
    for (size_t e = 0; e < M_0.size(); ++e) {
      ElementRays from = RaysFrom(e);
      Lanes<float> E;
      LaneMask mask;
      bool any = false;
      for (int i = 0; i < kLanes; ++i) {
        const vec3& p = from.origins_W[static_cast<size_t>(i)];
        E[i] = i < from.count ? LampIrradiance(lamp, p, from.n_W) : 0.0f;
        mask[i] = E[i] > 0.0f ? -1 : 0;
        any = any || E[i] > 0.0f;
        Aim(from.rays, i, p_WL - p, 1.0f);
      }
      if (!any) continue;
      const Lanes<float> visible = traced_.Transmittance(mask, from.rays, Coherence::kCoherent);
      for (int i = 0; i < kLanes; ++i) E[i] *= visible[i];
      M_0[e] += Mean(E, from.count) * intensity * reflectances_[e];
    }
  }
  return Bounced(PointIrradiances(bake_.point_count(), Spectrum(0.0f)), M_0);
}

DiffuseLight::PointIrradiances DiffuseLight::FromEmission() const {
  return Bounced(PointIrradiances(bake_.point_count(), Spectrum(0.0f)), emissions_);
}

}  // namespace fenestra
