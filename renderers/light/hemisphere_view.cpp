#include "renderers/light/hemisphere_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderers/light/lane_kernels.h"
#include "renderers/tracing/triangle_soup.h"

namespace fenestra {
namespace {

using glm::vec3;

// Transmittances that differ by more than this end differently; what a pane does varies less.
constexpr float kSameTransmittance = 0.1f;
constexpr uint32_t kOpen = ~0u;

// Of sixteen rays. From outside, they meet backs of bodies only where rounding lets one slip
// between two that touch; from inside all do but those that meet another body first.
constexpr int kMostBacks = 1;
// A point in an edge of two faces has half of its hemisphere near it; in a sharper one more.
constexpr int kMostNear = 12;
// Up to this many cells get four times the rays: where little is open, as in a room, its light is
// as exact as that of an open place.
constexpr size_t kFewCells = 40;
// At the rim of a sheet on the surface, half of them end on it.
constexpr int kNearOfFree = 2;

size_t CellIndex(int row, int column) {
  return static_cast<size_t>(row * kHemisphereCells + column);
}

Directions ToWorldAbout(const vec3& n, const DirectionSquare& square) {
  // A horizontal tangent keeps the pattern upright.
  const vec3 helper = std::abs(n.y) < 0.99f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
  const vec3 t = glm::normalize(glm::cross(helper, n));
  const vec3 b = glm::cross(n, t);
  Directions soa;
  for (int i = 0; i < kLanes; ++i) {
    const vec3& local = square[static_cast<size_t>(i)];
    const vec3 d = local.x * t + local.y * b + local.z * n;
    soa.x[i] = d.x;
    soa.y[i] = d.y;
    soa.z[i] = d.z;
  }
  return soa;
}

}  // namespace

// The end of a ray.
struct HemisphereCaster::Ending {
  uint32_t side = kOpen;  // The side of the surface that was hit.
  glm::vec2 st{0.0f};     // In its patch.
  float distance_m = 0.0f;
  float transmittance = 0.0f;
  vec3 direction_W{0.0f};

  bool DiffersFrom(const Ending& other) const {
    if ((side == kOpen) != (other.side == kOpen)) return true;
    if (std::abs(transmittance - other.transmittance) > kSameTransmittance) return true;
    return side == kOpen && (direction_W.y > 0.0f) != (other.direction_W.y > 0.0f);
  }
};

// Collects the ends of the rays from one point, each standing for a part of the hemisphere.
class HemisphereCaster::Tally {
 public:
  // `element`: what is seen of a surface.
  void Add(const Ending& ending, uint32_t element, float weight) {
    const bool upwards = ending.direction_W.y > 0.0f;
    const float seen = weight * ending.transmittance;
    (upwards ? unobstructed_sky_ : unobstructed_ground_) += weight;
    total_ += weight;
    if (ending.side == kOpen) {
      if (upwards) {
        SkyPart& part = sky_[static_cast<size_t>(SkyPatchOf(ending.direction_W))];
        part.w += seen;
        part.sum_W += seen * ending.direction_W;
      } else {
        ground_ += seen;
      }
      return;
    }
    const float distance_m = std::max(ending.distance_m, kNearest_m);
    curvature_ += weight / (distance_m * distance_m);
    if (element != LightElements::kNone) factors_.push_back({element, seen});
  }

  // The quadrature's parts above and below the horizon are scaled to their exact values for n.
  fenestra::OpenView OpenView(const vec3& n) const {
    const float sky = 0.5f * (1.0f + n.y);
    const float ground = 0.5f * (1.0f - n.y);
    const float to_sky =
        unobstructed_sky_ > 0.0f ? std::numbers::pi_v<float> * sky / unobstructed_sky_ : 0.0f;
    const float to_ground = unobstructed_ground_ > 0.0f ? ground / unobstructed_ground_ : 0.0f;
    fenestra::OpenView view{.sky = {}, .ground = to_ground * ground_};
    for (uint32_t patch = 0; patch < kSkyPatches; ++patch) {
      const SkyPart& part = sky_[patch];
      if (part.w > 0.0f) view.sky.push_back({patch, to_sky * part.w, to_sky * part.sum_W});
    }
    return view;
  }

  // One form factor per element, in the order of the elements.
  std::vector<FormFactor> Factors() {
    std::ranges::stable_sort(factors_, {}, &FormFactor::element);
    std::vector<FormFactor> out;
    for (const FormFactor& part : factors_) {
      if (out.empty() || out.back().element != part.element) out.push_back({part.element, 0.0f});
      out.back().w += part.w;
    }
    for (FormFactor& factor : out) factor.w /= total_;
    return out;
  }

  float Curvature() const { return curvature_ / total_; }

 private:
  // Nearer surfaces are as near.
  static constexpr float kNearest_m = 1e-4f;

  std::array<SkyPart, kSkyPatches> sky_{};
  float ground_ = 0.0f;
  float unobstructed_sky_ = 0.0f;
  float unobstructed_ground_ = 0.0f;
  float total_ = 0.0f;
  float curvature_ = 0.0f;
  std::vector<FormFactor> factors_;
};

namespace {

// Whether any of the eight neighbouring cells ends differently: with four, the corners of small
// openings would be lost.
template <typename Ending>
bool OnBoundary(const std::vector<Ending>& endings, int row, int column) {
  const Ending& here = endings[CellIndex(row, column)];
  const auto differs = [&](int r, int c) {
    return r >= 0 && r < kHemisphereCells && c >= 0 && c < kHemisphereCells &&
           here.DiffersFrom(endings[CellIndex(r, c)]);
  };
  for (int r = row - 1; r <= row + 1; ++r) {
    for (int c = column - 1; c <= column + 1; ++c) {
      if (differs(r, c)) return true;
    }
  }
  return false;
}

}  // namespace

HemisphereCaster::HemisphereCaster(const TracedScene& scene, const LightPatches& patches,
                                   LightElements& elements)
    : scene_(scene),
      patches_(patches),
      elements_(elements),
      offset_m_(scene.SurfaceOffset(vec3(0.0f))),
      directions_(MakeHemisphereDirections()),
      bounds_body_(BoundBodies(scene.opaque())) {}

HemisphereView HemisphereCaster::From(const BakePoint& point) {
  const std::vector<Ending> coarse = CastTiles(point);
  std::vector<size_t> divided;
  Tally tally;
  const auto see = [this](const Ending& ending) {
    return elements_.See(patches_, patches_.FaceOf(ending.side), {ending.side / 2, ending.st},
                         ending.distance_m);
  };
  for (int row = 0; row < kHemisphereCells; ++row) {
    for (int column = 0; column < kHemisphereCells; ++column) {
      const size_t cell = CellIndex(row, column);
      if (OnBoundary(coarse, row, column)) {
        divided.push_back(cell);
      } else {
        const Ending& ending = coarse[cell];
        tally.Add(ending, ending.side == kOpen ? LightElements::kNone : see(ending), 1.0f);
      }
    }
  }
  const bool few = divided.size() <= kFewCells;
  for (const size_t cell : divided) {
    // What is seen of one face in a cell is of one element.
    uint32_t face = LightElements::kNone;
    uint32_t element = LightElements::kNone;
    const auto add = [&](const DirectionSquare& square, float weight) {
      for (const Ending& ending : Cast(point, square)) {
        if (ending.side != kOpen && patches_.FaceOf(ending.side) != face) {
          face = patches_.FaceOf(ending.side);
          element = see(ending);
        }
        tally.Add(ending, ending.side == kOpen ? LightElements::kNone : element, weight);
      }
    };
    if (few) {
      for (const DirectionSquare& quarter : directions_.QuartersOf(cell)) {
        add(quarter, 1.0f / (4.0f * kLanes));
      }
    } else {
      add(directions_.cells[cell], 1.0f / kLanes);
    }
  }
  return {.open = tally.OpenView(point.n_W),
          .factors = tally.Factors(),
          .curvature_per_m2 = tally.Curvature()};
}

OpenView HemisphereCaster::Unobstructed(const BakePoint& point) const {
  Tally tally;
  for (const DirectionSquare& square : directions_.cells) {
    const Directions directions = ToWorldAbout(point.n_W, square);
    for (int i = 0; i < kLanes; ++i) {
      tally.Add({.transmittance = 1.0f,
                 .direction_W = {directions.x[i], directions.y[i], directions.z[i]}},
                LightElements::kNone, 1.0f);
    }
  }
  return tally.OpenView(point.n_W);
}

bool HemisphereCaster::Surroundings::IsHidden() const {
  return backs > kMostBacks || near > kMostNear;
}

bool HemisphereCaster::Surroundings::IsFree() const {
  return backs <= kMostBacks && near <= kNearOfFree;
}

HemisphereCaster::Surroundings HemisphereCaster::About(const BakePoint& point, float near_m) const {
  Surroundings about;
  for (const Ending& ending : Cast(point, directions_.whole)) {
    if (ending.side == kOpen) continue;
    if (ending.side % 2 == 1 && bounds_body_[ending.side / 2]) ++about.backs;
    if (ending.distance_m < near_m) ++about.near;
  }
  return about;
}

std::vector<HemisphereCaster::Ending> HemisphereCaster::CastTiles(const BakePoint& point) const {
  std::vector<Ending> endings(static_cast<size_t>(kHemisphereCells * kHemisphereCells));
  size_t tile = 0;
  for (int row = 0; row < kHemisphereCells; row += kDirectionSquare) {
    for (int column = 0; column < kHemisphereCells; column += kDirectionSquare) {
      const auto found = Cast(point, directions_.tiles[tile++]);
      for (int i = 0; i < kLanes; ++i) {
        endings[CellIndex(row + i / kDirectionSquare, column + i % kDirectionSquare)] =
            found[static_cast<size_t>(i)];
      }
    }
  }
  return endings;
}

std::array<HemisphereCaster::Ending, kLanes> HemisphereCaster::Cast(
    const BakePoint& point, const DirectionSquare& square) const {
  const Directions soa = ToWorldAbout(point.n_W, square);
  RayPacket packet;
  SetRays(packet, point.p_W + offset_m_ * point.n_W, soa);
  std::array<Ending, kLanes> endings;
  for (Ending& ending : endings) ending.transmittance = 1.0f;
  scene_.IntersectThroughPanes(
      FirstLanes(kLanes), packet, Coherence::kCoherent,
      [&](const LaneMask& panes, const RayPacket& at_panes) {
        const Lanes<float> reflectance = scene_.ReflectancesHit(panes, at_panes);
        for (int i = 0; i < kLanes; ++i) {
          endings[static_cast<size_t>(i)].transmittance *= 1.0f - reflectance[i];
        }
      });
  const auto triangle_count = static_cast<uint32_t>(scene_.opaque().size());
  const Lanes<uint32_t> sides = SidesHit(packet, triangle_count);
  for (int i = 0; i < kLanes; ++i) {
    Ending& ending = endings[static_cast<size_t>(i)];
    if (sides[i] < 2 * triangle_count) {
      ending.side = sides[i];
      ending.st = patches_.At(sides[i] / 2, packet.hit.u[i], packet.hit.v[i]);
    }
    ending.distance_m = packet.ray.tfar[i];
    ending.direction_W = {soa.x[i], soa.y[i], soa.z[i]};
  }
  return endings;
}

}  // namespace fenestra
