#include "renderers/light/light_bake.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "renderers/light/bake_rays.h"
#include "renderers/light/lane_kernels.h"

namespace fenestra {
namespace {

using glm::vec3;

// Transmittances that differ by more than this end differently; what a pane does varies less.
constexpr float kSameTransmittance = 0.1f;
constexpr uint32_t kOpen = ~0u;

// The end of a ray.
struct Ending {
  uint32_t side = kOpen;  // The side of the surface that was hit.
  float transmittance = 0.0f;
  vec3 direction_W{0.0f};

  bool DiffersFrom(const Ending& other) const {
    if ((side == kOpen) != (other.side == kOpen)) return true;
    if (std::abs(transmittance - other.transmittance) > kSameTransmittance) return true;
    return side == kOpen && (direction_W.y > 0.0f) != (other.direction_W.y > 0.0f);
  }
};

// Collects the ends of the rays from one point, each standing for a part of the hemisphere.
class ViewTally {
 public:
  void Add(const Ending& ending, float weight) {
    if (ending.side != kOpen) {
      factors_.push_back({ending.side, weight * ending.transmittance});
    } else if (ending.direction_W.y > 0.0f) {
      view_.sky[static_cast<size_t>(SkyPatchOf(ending.direction_W))] +=
          weight * ending.transmittance;
      unobstructed_sky_ += weight;
    } else {
      view_.ground += weight * ending.transmittance;
      unobstructed_ground_ += weight;
    }
    if (ending.side != kOpen) {
      (ending.direction_W.y > 0.0f ? unobstructed_sky_ : unobstructed_ground_) += weight;
    }
    total_ += weight;
  }

  // The quadrature's parts above and below the horizon are scaled to their exact values for n.
  LightBake::OpenView OpenView(const vec3& n) const {
    const float sky = 0.5f * (1.0f + n.y);
    const float ground = 0.5f * (1.0f - n.y);
    LightBake::OpenView view = view_;
    const float to_sky =
        unobstructed_sky_ > 0.0f ? std::numbers::pi_v<float> * sky / unobstructed_sky_ : 0.0f;
    for (float& s : view.sky) s *= to_sky;
    view.ground *= unobstructed_ground_ > 0.0f ? ground / unobstructed_ground_ : 0.0f;
    return view;
  }

  // One form factor per side, in the order of the sides.
  void AppendFactors(std::vector<LightBake::FormFactor>& out) {
    std::ranges::sort(factors_, {}, &LightBake::FormFactor::side);
    for (size_t i = 0; i < factors_.size();) {
      LightBake::FormFactor sum{factors_[i].side, 0.0f};
      for (; i < factors_.size() && factors_[i].side == sum.side; ++i) sum.w += factors_[i].w;
      sum.w /= total_;
      out.push_back(sum);
    }
  }

 private:
  LightBake::OpenView view_;
  float unobstructed_sky_ = 0.0f;
  float unobstructed_ground_ = 0.0f;
  float total_ = 0.0f;
  std::vector<LightBake::FormFactor> factors_;
};

class Baker {
 public:
  explicit Baker(const TracedScene& scene)
      : scene_(scene),
        offset_m_(scene.SurfaceOffset(vec3(0.0f))),
        directions_(MakeHemisphereDirections()) {}

  ViewTally ViewFrom(const BakePoint& point) const {
    const std::vector<Ending> coarse = CastTiles(point);
    ViewTally tally;
    for (int row = 0; row < kHemisphereCells; ++row) {
      for (int column = 0; column < kHemisphereCells; ++column) {
        const size_t cell = CellIndex(row, column);
        if (!OnBoundary(coarse, row, column)) {
          tally.Add(coarse[cell], static_cast<float>(kLanes));
          continue;
        }
        for (const Ending& ending : Cast(point, directions_.cells[cell])) tally.Add(ending, 1.0f);
      }
    }
    return tally;
  }

  // The view if nothing stood before the point.
  LightBake::OpenView UnobstructedView(const BakePoint& point) const {
    ViewTally tally;
    for (const DirectionSquare& square : directions_.cells) {
      const Directions directions = ToWorldAbout(point.n_W, square);
      for (int i = 0; i < kLanes; ++i) {
        tally.Add({.transmittance = 1.0f,
                   .direction_W = {directions.x[i], directions.y[i], directions.z[i]}},
                  1.0f);
      }
    }
    return tally.OpenView(point.n_W);
  }

 private:
  static size_t CellIndex(int row, int column) {
    return static_cast<size_t>(row * kHemisphereCells + column);
  }

  std::vector<Ending> CastTiles(const BakePoint& point) const {
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

  static bool OnBoundary(const std::vector<Ending>& endings, int row, int column) {
    const Ending& here = endings[CellIndex(row, column)];
    const auto differs = [&](int r, int c) {
      return r >= 0 && r < kHemisphereCells && c >= 0 && c < kHemisphereCells &&
             here.DiffersFrom(endings[CellIndex(r, c)]);
    };
    return differs(row - 1, column) || differs(row + 1, column) || differs(row, column - 1) ||
           differs(row, column + 1);
  }

  static Directions ToWorldAbout(const vec3& n, const DirectionSquare& square) {
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

  std::array<Ending, kLanes> Cast(const BakePoint& point, const DirectionSquare& square) const {
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
      ending.side = sides[i] < 2 * triangle_count ? sides[i] : kOpen;
      ending.direction_W = {soa.x[i], soa.y[i], soa.z[i]};
    }
    return endings;
  }

  const TracedScene& scene_;
  float offset_m_;
  HemisphereDirections directions_;
};

// Whether no part of the scene lies before the plane through p with normal n.
bool IsSupportingPlane(const TracedScene& scene, const vec3& p, const vec3& n) {
  constexpr float kInPlane_m = 1e-4f;
  const float distance_m = glm::dot(p, n) + kInPlane_m;
  const auto behind = [&](const vec3& q) { return glm::dot(q, n) <= distance_m; };
  return std::ranges::all_of(scene.opaque().positions_W, behind) &&
         std::ranges::all_of(scene.panes().positions_W, behind);
}

// Comparisons of a position with a plane that are worth the rays they save.
constexpr size_t kMostComparisons = 2'000'000'000;

// Adds the points of all corners; returns those of each corner's front and back.
std::vector<std::array<uint32_t, 2>> BakeCorners(const TracedScene& scene,
                                                 const std::vector<SharedCorner>& corners,
                                                 LightBake& bake) {
  constexpr uint32_t kObstructed = ~0u;
  const Baker baker(scene);
  std::map<std::pair<uint32_t, bool>, uint32_t> view_of_plane;  // Of each plane's two sides.
  std::vector<std::array<uint32_t, 2>> points(corners.size(),
                                              {LightBake::kNoPoint, LightBake::kNoPoint});
  bake.first_factor.push_back(0);
  // Of the planes beyond these, rays find the same, if later.
  size_t planes_left =
      kMostComparisons /
      std::max<size_t>(scene.opaque().positions_W.size() + scene.panes().positions_W.size(), 1);
  const auto new_view = [&bake](const LightBake::OpenView& view) {
    bake.open_views.push_back(view);
    return static_cast<uint32_t>(bake.open_views.size() - 1);
  };
  for (size_t i = 0; i < corners.size(); ++i) {
    for (const bool front : {true, false}) {
      if (!front && corners[i].is_closed) continue;
      const BakePoint point = corners[i].Side(front);
      uint32_t view = kObstructed;
      if (!corners[i].is_smooth) {
        const auto [entry, is_new] =
            view_of_plane.try_emplace({corners[i].surface, front}, kObstructed);
        if (is_new && planes_left > 0 && planes_left-- > 0 &&
            IsSupportingPlane(scene, point.p_W, point.n_W)) {
          entry->second = new_view(baker.UnobstructedView(point));
        }
        view = entry->second;
      }
      if (view == kObstructed) {
        ViewTally tally = baker.ViewFrom(point);
        view = new_view(tally.OpenView(point.n_W));
        tally.AppendFactors(bake.factors);
      }
      points[i][front ? 0 : 1] = static_cast<uint32_t>(bake.point_count());
      bake.open_view_of.push_back(view);
      bake.first_factor.push_back(bake.factors.size());
    }
  }
  return points;
}

}  // namespace

LightBake BakeLight(const TracedScene& scene, const std::vector<uint32_t>& surfaces,
                    size_t most_points) {
  // A corner has a point on each side.
  const SharedCorners shared =
      Thinned(FindSharedCorners(scene.opaque(), surfaces), most_points / 2);
  LightBake bake;
  const auto points = BakeCorners(scene, shared.corners, bake);
  bake.corners.reserve(2 * shared.of_triangle.size());
  for (const std::array<size_t, 3>& ids : shared.of_triangle) {
    for (const size_t side : {size_t{0}, size_t{1}}) {
      bake.corners.push_back({points[ids[0]][side], points[ids[1]][side], points[ids[2]][side]});
    }
  }
  return bake;
}

}  // namespace fenestra
