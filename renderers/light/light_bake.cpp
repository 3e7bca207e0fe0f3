#include "renderers/light/light_bake.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <span>

#include "renderers/light/bake_rays.h"

namespace fenestra {
namespace {

using glm::vec3;

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

// The triangles that meet in each corner.
class TrianglesAtCorners {
 public:
  explicit TrianglesAtCorners(const SharedCorners& shared) : first_(shared.corners.size() + 1, 0) {
    for (const auto& ids : shared.of_triangle) {
      for (const size_t id : ids) ++first_[id + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    triangles_.resize(first_.back());
    std::vector<size_t> next(first_.begin(), first_.end() - 1);
    for (uint32_t t = 0; t < shared.of_triangle.size(); ++t) {
      for (const size_t id : shared.of_triangle[t]) triangles_[next[id]++] = t;
    }
  }

  std::span<const uint32_t> At(size_t corner) const {
    return std::span(triangles_).subspan(first_[corner], first_[corner + 1] - first_[corner]);
  }

 private:
  std::vector<size_t> first_;
  std::vector<uint32_t> triangles_;
};

// Finds where the light of a corner is baked: at the corner, or if that is hidden, as near to it on
// its triangles as something can be seen.
class VisiblePoints {
 public:
  VisiblePoints(const TriangleSoup& soup, const SharedCorners& shared,
                const HemisphereCaster& caster)
      : soup_(soup), shared_(shared), triangles_(shared), caster_(caster) {}

  BakePoint Find(size_t corner, bool front) const {
    const SharedCorner& c = shared_.corners[corner];
    const BakePoint point = c.Side(front);
    // All inside a body is hidden.
    if (!front && caster_.BoundsBody(triangles_.At(corner).front())) return point;
    const float near_m = kNear * SizeAt(corner);
    if (!caster_.About(point, near_m).IsHidden()) return point;
    std::optional<BakePoint> visible;
    for (const vec3& p_W : Nearby(corner)) {
      const BakePoint nearby{p_W, point.n_W};
      const HemisphereCaster::Surroundings about = caster_.About(nearby, near_m);
      if (about.IsFree()) return nearby;
      if (!visible && !about.IsHidden()) visible = nearby;
    }
    return visible.value_or(point);  // If all is hidden, what it has is as good as anything.
  }

 private:
  // What ends nearer than this part of a triangle's size lies on it.
  static constexpr float kNear = 0.1f;
  static constexpr size_t kMostTried = 64;

  // The largest distance of the centroid of a triangle that meets here.
  float SizeAt(size_t corner) const {
    float size_m = 0.0f;
    for (const uint32_t t : triangles_.At(corner)) {
      size_m = std::max(size_m, glm::distance(Centroid(t), shared_.corners[corner].p_W));
    }
    return size_m;
  }

  // Points of the corner's triangles, the nearest first.
  std::vector<vec3> Nearby(size_t corner) const {
    std::vector<vec3> points;
    for (const uint32_t t : triangles_.At(corner)) {
      const vec3 centroid = Centroid(t);
      for (int k = 0; k < 3; ++k) {
        if (shared_.of_triangle[t][static_cast<size_t>(k)] != corner) continue;
        for (const float part : {0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.75f, 1.0f}) {
          points.push_back(glm::mix(Position(t, k), centroid, part));
        }
      }
    }
    const vec3& p_W = shared_.corners[corner].p_W;
    const auto distance = [&p_W](const vec3& q_W) { return glm::distance(p_W, q_W); };
    std::ranges::stable_sort(points, {}, distance);
    if (points.size() > kMostTried) points.resize(kMostTried);
    return points;
  }

  vec3 Centroid(uint32_t triangle) const {
    return (Position(triangle, 0) + Position(triangle, 1) + Position(triangle, 2)) / 3.0f;
  }
  const vec3& Position(uint32_t triangle, int k) const {
    return soup_.positions_W[soup_.triangles[triangle][k]];
  }

  const TriangleSoup& soup_;
  const SharedCorners& shared_;
  TrianglesAtCorners triangles_;
  const HemisphereCaster& caster_;
};

// Adds the points of all corners; returns those of each corner's front and back.
std::vector<std::array<uint32_t, 2>> BakeCorners(const TracedScene& scene,
                                                 const SharedCorners& shared, LightBake& bake) {
  constexpr uint32_t kObstructed = ~0u;
  const HemisphereCaster caster(scene);
  const VisiblePoints visible(scene.opaque(), shared, caster);
  const std::vector<SharedCorner>& corners = shared.corners;
  std::map<std::pair<uint32_t, bool>, uint32_t> view_of_plane;  // Of each plane's two sides.
  std::vector<std::array<uint32_t, 2>> points(corners.size(),
                                              {LightBake::kNoPoint, LightBake::kNoPoint});
  bake.first_factor.push_back(0);
  // Of the planes beyond these, rays find the same, if later.
  size_t planes_left =
      kMostComparisons /
      std::max<size_t>(scene.opaque().positions_W.size() + scene.panes().positions_W.size(), 1);
  const auto new_view = [&bake](const OpenView& view) {
    bake.open_views.push_back(view);
    return static_cast<uint32_t>(bake.open_views.size() - 1);
  };
  for (size_t i = 0; i < corners.size(); ++i) {
    for (const bool front : {true, false}) {
      if (!front && corners[i].is_closed) continue;
      uint32_t view = kObstructed;
      if (!corners[i].is_smooth) {
        const BakePoint point = corners[i].Side(front);
        const auto [entry, is_new] =
            view_of_plane.try_emplace({corners[i].surface, front}, kObstructed);
        if (is_new && planes_left > 0 && planes_left-- > 0 &&
            IsSupportingPlane(scene, point.p_W, point.n_W)) {
          entry->second = new_view(caster.Unobstructed(point));
        }
        view = entry->second;
      }
      if (view == kObstructed) {
        const HemisphereView seen = caster.From(visible.Find(i, front));
        view = new_view(seen.open);
        bake.factors.insert(bake.factors.end(), seen.factors.begin(), seen.factors.end());
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
  const auto points = BakeCorners(scene, shared, bake);
  bake.corners.reserve(2 * shared.of_triangle.size());
  for (const std::array<size_t, 3>& ids : shared.of_triangle) {
    for (const size_t side : {size_t{0}, size_t{1}}) {
      bake.corners.push_back({points[ids[0]][side], points[ids[1]][side], points[ids[2]][side]});
    }
  }
  return bake;
}

}  // namespace fenestra
