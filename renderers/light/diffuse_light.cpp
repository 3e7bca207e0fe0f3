#include "renderers/light/diffuse_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "renderers/tracing/sobol_samples.h"

namespace fenestra {
namespace {

using glm::vec3;

// Changes below this part of the largest irradiance are invisible: a sensor's noise is a hundred
// times larger.
constexpr float kSettled = 1e-5f;

vec3 ToVec3(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// Sixteen points spread evenly over a triangle, as barycentric (u, v): the square's points beyond
// the diagonal are folded back.
std::array<glm::vec2, kLanes> TrianglePoints() {
  std::array<glm::vec2, kLanes> points;
  for (uint32_t i = 0; i < kLanes; ++i) {
    const SobolPoint net = NthSobolPoint(i);
    // Half a step of 1/16 in, so that the points are symmetric in the square.
    const glm::vec2 p(ToUnit(net.x) + 1.0f / 32.0f, ToUnit(net.y) + 1.0f / 32.0f);
    points[i] = p.x + p.y < 1.0f ? p : 1.0f - p;
  }
  return points;
}

const std::array<glm::vec2, kLanes> kTrianglePoints = TrianglePoints();

// Rays from points of one side of a triangle.
struct SideRays {
  RTCRay16 rays;
  std::array<vec3, kLanes> origins_W;
};

SideRays RaysFromSide(const TriangleSoup& soup, size_t triangle, const vec3& n_W, float offset_m) {
  const glm::uvec3& corners = soup.triangles[triangle];
  const vec3& a = soup.positions_W[corners.x];
  const vec3 to_b = soup.positions_W[corners.y] - a;
  const vec3 to_c = soup.positions_W[corners.z] - a;
  SideRays out;
  for (int i = 0; i < kLanes; ++i) {
    const glm::vec2& uv = kTrianglePoints[static_cast<size_t>(i)];
    const vec3 p = a + uv.x * to_b + uv.y * to_c + offset_m * n_W;
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

void Aim(RTCRay16& rays, int lane, const vec3& direction, float tfar) {
  rays.dir_x[lane] = direction.x;
  rays.dir_y[lane] = direction.y;
  rays.dir_z[lane] = direction.z;
  rays.tfar[lane] = tfar;
}

float Mean(const Lanes<float>& values) {
  float sum = 0.0f;
  for (int i = 0; i < kLanes; ++i) sum += values[i];
  return sum / static_cast<float>(kLanes);
}

// Calls f(side, triangle, normal) for all sides that light can leave.
template <typename Function>
void ForEachSide(const TriangleSoup& soup, const Function& f) {
  for (size_t t = 0; t < soup.size(); ++t) {
    for (const bool front : {true, false}) {
      if (!front && soup.is_closed[t]) continue;
      f(SideIndex(t, front), t, front ? soup.normals_W[t] : -soup.normals_W[t]);
    }
  }
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
    : scene_(scene),
      traced_(traced),
      bake_(bake),
      bounces_(bounces),
      reflectances_(bake.corners.size(), Spectrum(0.0f)),
      emissions_(bake.corners.size(), Spectrum(0.0f)) {
  const TriangleSoup& soup = traced.opaque();
  ForEachSide(soup, [&](size_t side, size_t t, const vec3&) {
    const Material& material = scene.materials[scene.meshes[soup.mesh_of[t]].material];
    Spectrum pattern(1.0f);
    const auto triangle = static_cast<uint32_t>(t);
    if (traced.patterns().has_pattern(triangle)) {
      pattern = PatternSpectrum(traced.patterns().Mean(triangle));
    }
    reflectances_[side] = pattern * ReflectanceSpectrum(material);
    emissions_[side] = std::numbers::pi_v<float> * pattern * EmissionSpectrum(material);
  });
}

DiffuseLight::PointIrradiances DiffuseLight::Bounced(const PointIrradiances& open,
                                                     const std::vector<Spectrum>& M_0) const {
  PointIrradiances E = open;
  std::vector<Spectrum> M(M_0.size());
  bool settled = false;
  for (int bounce = 0; bounce < bounces_ && !settled; ++bounce) {
    float largest = 0.0f;
    float largest_change = 0.0f;
    for (size_t s = 0; s < M.size(); ++s) {
      const std::array<uint32_t, 3>& corners = bake_.corners[s];
      if (corners[0] == LightBake::kNoPoint) continue;
      const Spectrum mean = (E[corners[0]] + E[corners[1]] + E[corners[2]]) * (1.0f / 3.0f);
      M[s] = M_0[s] + reflectances_[s] * mean;
    }
    for (size_t p = 0; p < E.size(); ++p) {
      Spectrum sum = open[p];
      for (size_t i = bake_.first_factor[p]; i < bake_.first_factor[p + 1]; ++i) {
        sum += bake_.factors[i].w * M[bake_.factors[i].side];
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
  const std::array<double, kSkyPatches> luminances = PatchLuminances(dome);
  std::vector<float> of_view;
  of_view.reserve(bake_.open_views.size());
  for (const OpenView& view : bake_.open_views) {
    double E = 0.0;
    for (size_t k = 0; k < kSkyPatches; ++k) E += static_cast<double>(view.sky[k]) * luminances[k];
    of_view.push_back(static_cast<float>(E));
  }
  PointIrradiances open;
  open.reserve(bake_.point_count());
  for (const uint32_t view : bake_.open_view_of) open.emplace_back(of_view[view]);
  return Bounced(open, std::vector<Spectrum>(bake_.corners.size(), Spectrum(0.0f)));
}

DiffuseLight::PointIrradiances DiffuseLight::FromGround() const {
  PointIrradiances open;
  open.reserve(bake_.point_count());
  for (const uint32_t view : bake_.open_view_of) open.emplace_back(bake_.open_views[view].ground);
  return Bounced(open, std::vector<Spectrum>(bake_.corners.size(), Spectrum(0.0f)));
}

DiffuseLight::PointIrradiances DiffuseLight::FromSun(const glm::vec3& to_sun_W) const {
  const float offset_m = traced_.SurfaceOffset(vec3(0.0f));
  std::vector<Spectrum> M_0(bake_.corners.size(), Spectrum(0.0f));
  ForEachSide(traced_.opaque(), [&](size_t side, size_t t, const vec3& n) {
    const float cosine = glm::dot(n, to_sun_W);
    if (!(cosine > 0.0f)) return;
    SideRays from = RaysFromSide(traced_.opaque(), t, n, offset_m);
    for (int i = 0; i < kLanes; ++i) {
      Aim(from.rays, i, to_sun_W, std::numeric_limits<float>::infinity());
    }
    const float visible =
        Mean(traced_.Transmittance(FirstLanes(kLanes), from.rays, Coherence::kCoherent));
    M_0[side] = cosine * visible * reflectances_[side];
  });
  return Bounced(PointIrradiances(bake_.point_count(), Spectrum(0.0f)), M_0);
}

DiffuseLight::PointIrradiances DiffuseLight::FromLamps() const {
  const float offset_m = traced_.SurfaceOffset(vec3(0.0f));
  std::vector<Spectrum> M_0(bake_.corners.size(), Spectrum(0.0f));
  for (const Lamp& lamp : scene_.lamps) {
    const Spectrum intensity = IntensitySpectrum(lamp);
    const vec3 p_WL = ToVec3(lamp.p_WL);
    ForEachSide(traced_.opaque(), [&](size_t side, size_t t, const vec3& n) {
      SideRays from = RaysFromSide(traced_.opaque(), t, n, offset_m);
      Lanes<float> E;
      LaneMask mask;
      bool any = false;
      for (int i = 0; i < kLanes; ++i) {
        const vec3& p = from.origins_W[static_cast<size_t>(i)];
        E[i] = LampIrradiance(lamp, p, n);
        mask[i] = E[i] > 0.0f ? -1 : 0;
        any = any || E[i] > 0.0f;
        Aim(from.rays, i, p_WL - p, 1.0f);
      }
      if (!any) return;
      const Lanes<float> visible = traced_.Transmittance(mask, from.rays, Coherence::kCoherent);
      for (int i = 0; i < kLanes; ++i) E[i] *= visible[i];
      M_0[side] += Mean(E) * intensity * reflectances_[side];
    });
  }
  return Bounced(PointIrradiances(bake_.point_count(), Spectrum(0.0f)), M_0);
}

DiffuseLight::PointIrradiances DiffuseLight::FromEmission() const {
  return Bounced(PointIrradiances(bake_.point_count(), Spectrum(0.0f)), emissions_);
}

}  // namespace fenestra
