#include "renderers/light/light_bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "renderers/light/bake_rays.h"

namespace fenestra {
namespace {

using glm::vec2;
using glm::vec3;

constexpr uint32_t kNoPoint = ~0u;
// Instead of a point that no viewer can see.
constexpr uint32_t kHidden = ~0u - 1u;

// Leaves are no longer than the first and not halved below the second.
constexpr float kLongestLeaf_m = 1.5f;
constexpr float kShortestLeaf_m = 0.03f;
// A leaf of which nothing seems to be visible is no longer than this: parts of it may be.
constexpr float kLongestHiddenLeaf_m = 0.25f;
// A leaf is not halved if what its corners see cannot curve its light by more than this part.
constexpr float kFlat = 0.005f;
// Interpolated light may be off by this part of itself, and of the light from all of the sky, on
// leaves of these sizes; on smaller ones, of which fewer pixels are seen, by more in proportion.
constexpr float kTolerance = 0.03f;
constexpr float kToleranceSize_m = 0.25f;
constexpr float kFloor = 5e-4f;
constexpr float kFloorSize_m = 1.0f;
// Reflectances of the ground and of all surfaces where the light's variation is judged.
constexpr float kGroundReflectance = 0.2f;
constexpr float kReflectance = 0.5f;
constexpr int kBounces = 8;

// Points are moved this part of its size into a patch: on the edge itself, a ray into the
// neighbouring solid would start on that solid's surface and might miss it.
constexpr float kInwards = 1e-3f;
constexpr float kInwardsOfTriangle = 0.02f;
// What ends nearer than the lesser of this and a part of the patch's size lies on it.
constexpr float kNear_m = 0.005f;
constexpr float kNear = 0.01f;

// Comparisons of a position with a plane that are worth the rays they save.
constexpr size_t kMostComparisons = 2'000'000'000;

// Whether no part of the scene lies before the plane through p with normal n.
bool IsSupportingPlane(const TracedScene& scene, const vec3& p, const vec3& n) {
  constexpr float kInPlane_m = 1e-4f;
  const float distance_m = glm::dot(p, n) + kInPlane_m;
  const auto behind = [&](const vec3& q) { return glm::dot(q, n) <= distance_m; };
  return std::ranges::all_of(scene.opaque().positions_W, behind) &&
         std::ranges::all_of(scene.panes().positions_W, behind);
}

int HalvingsTo(float size_m, float longest_m) {
  constexpr int kMost = 6;
  const float halvings = std::ceil(std::log2(std::max(size_m / longest_m, 1.0f)));
  return std::min(static_cast<int>(halvings), kMost);
}

// Of the means of elements: their samples' places in leaves.
std::vector<PointWeight> MeanOf(const LightElements& elements, const LightLeaves& leaves,
                                size_t element) {
  const auto samples = elements.SamplesOf(element);
  const uint32_t face = elements.FaceOf(element);
  const float share = 1.0f / static_cast<float>(samples.size());
  std::map<uint32_t, float> weights;
  for (const LightElements::Sample& sample : samples) {
    const LightLeaves::Leaf& leaf = leaves.leaves()[leaves.Find(face, sample.st)];
    for (size_t k = 0; k < 3; ++k) {
      std::array<float, 3> unit{};
      unit[k] = 1.0f;
      const std::array<float, 3> c = leaf.Interpolate(unit);
      weights[leaf.points[k]] += share * (c[0] + c[1] * sample.st.x + c[2] * sample.st.y);
    }
  }
  std::vector<PointWeight> mean;
  for (const auto& [point, weight] : weights) mean.push_back({point, weight});
  return mean;
}

// One face while its grid is being refined.
struct FaceGrid {
  explicit FaceGrid(LightGrid the_grid) : grid(std::move(the_grid)) {}

  LightGrid grid;
  std::vector<bool> is_settled;                          // Of each cell.
  std::unordered_map<uint64_t, uint32_t> of_node;        // A point, or kHidden.
  std::map<std::pair<size_t, int>, uint32_t> of_corner;  // Instead of hidden nodes.
};

class Baker {
 public:
  Baker(const TracedScene& scene, const std::vector<uint32_t>& surfaces, size_t most_points)
      : scene_(scene),
        most_points_(most_points),
        patches_(scene.opaque(), surfaces),
        caster_(scene, patches_, elements_),
        grids_(patches_.face_count()),
        open_points_(patches_.face_count(), kNoPoint),
        first_factor_{0} {}

  LightBake Bake() {
    MakeGrids();
    if (CountFirstPoints() <= most_points_) {
      Solve(Leaves());
      for (uint32_t face = 0; face < grids_.size(); ++face) {
        if (grids_[face]) SplitAlongLongSide(face);
      }
      while (HalveLeaves()) {
      }
    } else {
      ShareFirstPoints();
    }
    LightLeaves leaves = Leaves();
    std::vector<size_t> first_mean{0};
    std::vector<PointWeight> means;
    for (size_t e = 0; e < elements_.size(); ++e) {
      const std::vector<PointWeight> mean = MeanOf(elements_, leaves, e);
      means.insert(means.end(), mean.begin(), mean.end());
      first_mean.push_back(means.size());
    }
    return {.patches = std::move(patches_),
            .elements = std::move(elements_),
            .leaves = std::move(leaves),
            .open_view_of = std::move(open_view_of_),
            .open_views = std::move(open_views_),
            .first_factor = std::move(first_factor_),
            .factors = std::move(factors_),
            .first_mean = std::move(first_mean),
            .means = std::move(means)};
  }

 private:
  vec3 NormalOf(uint32_t face) const {
    const vec3& n = patches_.PatchOfFace(face).n_W;
    return LightPatches::IsFront(face) ? n : -n;
  }

  float NearOf(const LightPatch& patch) const {
    const float size_m = std::max(patch.width_m, patch.height_m);
    return std::min(kNear_m, kNear * size_m);
  }

  // Faces before which nothing stands have one point, others a grid.
  void MakeGrids() {
    const TriangleSoup& soup = scene_.opaque();
    size_t planes_left =
        kMostComparisons /
        std::max<size_t>(soup.positions_W.size() + scene_.panes().positions_W.size(), 1);
    std::map<std::pair<uint32_t, bool>, uint32_t> open_point_of;  // Of each surface's two sides.
    for (uint32_t face = 0; face < patches_.face_count(); ++face) {
      const LightPatch& patch = patches_.PatchOfFace(face);
      const bool front = LightPatches::IsFront(face);
      if (patch.is_smooth || (!front && !patch.has_back)) continue;
      const auto [entry, is_new] = open_point_of.try_emplace({patch.surface, front}, kNoPoint);
      const BakePoint point{patch.At({0.5f, 0.5f}), NormalOf(face)};
      if (is_new && planes_left > 0 && planes_left-- > 0 &&
          IsSupportingPlane(scene_, point.p_W, point.n_W)) {
        entry->second = AddOpenPoint(point);
      }
      open_points_[face] = entry->second;
      if (entry->second != kNoPoint) continue;
      grids_[face].emplace(LightGrid(patches_, face / 2, HalvingsTo(patch.width_m, kLongestLeaf_m),
                                     HalvingsTo(patch.height_m, kLongestLeaf_m)));
      if (grids_[face]->grid.UsedLeaves().empty()) {  // What is thinner than rounding.
        grids_[face].reset();
        open_points_[face] = AddPoint(caster_.From(point));
      }
    }
  }

  uint32_t AddOpenPoint(const BakePoint& point) {
    return AddPoint({.open = caster_.Unobstructed(point), .factors = {}, .curvature_per_m2 = 0.0f});
  }

  uint32_t AddPoint(const HemisphereView& view) {
    const auto point = static_cast<uint32_t>(open_view_of_.size());
    open_view_of_.push_back(static_cast<uint32_t>(open_views_.size()));
    open_views_.push_back(view.open);
    factors_.insert(factors_.end(), view.factors.begin(), view.factors.end());
    first_factor_.push_back(factors_.size());
    curvature_per_m2_.push_back(view.curvature_per_m2);
    float open = kGroundReflectance * view.open.ground;
    for (const SkyPart& part : view.open.sky) open += part.w / std::numbers::pi_v<float>;
    open_light_.push_back(open);
    if (is_solved_) ExtendExitances();
    light_.push_back(LightOf(point));
    return point;
  }

  // Irradiance by a uniform sky of horizontal illuminance 1, with what it lights.
  float LightOf(uint32_t point) const {
    float light = open_light_[point];
    if (exitances_.empty()) return light;
    for (size_t i = first_factor_[point]; i < first_factor_[point + 1]; ++i) {
      light += factors_[i].w * exitances_[factors_[i].element];
    }
    return light;
  }

  // Of all elements that have been seen so far; those to come send out what they do at their first
  // place by then.
  void Solve(LightLeaves leaves) {
    std::vector<std::vector<PointWeight>> means;
    for (size_t e = 0; e < elements_.size(); ++e) means.push_back(MeanOf(elements_, leaves, e));
    exitances_.assign(elements_.size(), 0.0f);
    for (int bounce = 0; bounce < kBounces; ++bounce) {
      for (uint32_t point = 0; point < light_.size(); ++point) light_[point] = LightOf(point);
      for (size_t e = 0; e < elements_.size(); ++e) {
        float mean = 0.0f;
        for (const PointWeight& p : means[e]) mean += p.w * light_[p.point];
        exitances_[e] = kReflectance * mean;
      }
    }
    for (uint32_t point = 0; point < light_.size(); ++point) light_[point] = LightOf(point);
    solved_leaves_ = std::move(leaves);
    is_solved_ = true;
  }

  // Exitances of the elements that a point saw first.
  void ExtendExitances() {
    for (size_t e = exitances_.size(); e < elements_.size(); ++e) {
      float mean = 0.0f;
      for (const PointWeight& p : MeanOf(elements_, solved_leaves_, e)) {
        mean += p.w * light_[p.point];
      }
      exitances_.push_back(kReflectance * mean);
    }
  }

  // A node of a face's grid, a little inside the patch.
  BakePoint PlaceOf(uint32_t face, const vec2& st) const {
    const LightPatch& patch = patches_.PatchOfFace(face);
    const auto inwards = [this](const vec3& axis) {
      const float length_m = glm::length(axis);
      return std::min(std::max(kInwards, 4.0f * caster_.offset_m() / length_m), 0.1f);
    };
    const vec2 margin(inwards(patch.s_axis_W), inwards(patch.t_axis_W));
    return {patch.At(glm::clamp(st, margin, 1.0f - margin)), NormalOf(face)};
  }

  bool IsHidden(uint32_t face, const BakePoint& place) const {
    return caster_.About(place, NearOf(patches_.PatchOfFace(face))).IsHidden();
  }

  // kHidden if no viewer can see it.
  uint32_t PointAt(uint32_t face, const GridNode& node) {
    const uint64_t key = (static_cast<uint64_t>(node.s) << 32) | static_cast<uint64_t>(node.t);
    const auto [entry, is_new] = grids_[face]->of_node.try_emplace(key, kHidden);
    if (is_new) {
      const BakePoint place = PlaceOf(face, InPatch(node));
      if (!IsHidden(face, place)) entry->second = AddPoint(caster_.From(place));
    }
    return entry->second;
  }

  uint32_t CornerPoint(uint32_t face, size_t leaf, int k) {
    const LightGrid::Cell cell = grids_[face]->grid.cells()[leaf];
    const GridNode& node = cell.corners[static_cast<size_t>(k)];
    const uint32_t own = PointAt(face, node);
    if (own != kHidden) return own;
    // Corners of which none is visible share what is found for the first.
    const int shared = IsHiddenLeaf(face, cell) ? 0 : k;
    const auto [entry, is_new] = grids_[face]->of_corner.try_emplace({leaf, shared}, kNoPoint);
    if (is_new) {
      entry->second = AddPoint(
          caster_.From(VisiblePlace(face, cell, cell.corners[static_cast<size_t>(shared)])));
    }
    return entry->second;
  }

  // Whether nothing of a leaf seems to be visible.
  bool IsHiddenLeaf(uint32_t face, const LightGrid::Cell& cell) {
    return PointAt(face, cell.Middle()) == kHidden &&
           std::ranges::all_of(
               cell.corners, [&](const GridNode& node) { return PointAt(face, node) == kHidden; });
  }

  // The nearest place to a corner in its leaf that a viewer can see, or the leaf's middle.
  BakePoint VisiblePlace(uint32_t face, const LightGrid::Cell& cell, const GridNode& node) const {
    const vec2 from = InPatch(node);
    const std::array<vec2, 3> corners = {InPatch(cell.corners[0]), InPatch(cell.corners[1]),
                                         InPatch(cell.corners[2])};
    const vec2 centre = (corners[0] + corners[1] + corners[2]) / 3.0f;
    std::vector<vec2> aims = {centre};
    for (const vec2& corner : corners) {
      if (corner != from) aims.push_back(glm::mix(corner, centre, 0.1f));
    }
    for (const float part : {0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.75f, 1.0f}) {
      for (const vec2& aim : aims) {
        const BakePoint place = PlaceOf(face, glm::mix(from, aim, part));
        if (!IsHidden(face, place)) return place;
      }
    }
    return PlaceOf(face, centre);
  }

  // Long rectangles are halved along their long side first, as long as light varies along it.
  void SplitAlongLongSide(uint32_t face) {
    const LightPatch& patch = patches_.PatchOfFace(face);
    const LightGrid& grid = grids_[face]->grid;
    int s_halvings = grid.s_halvings();
    int t_halvings = grid.t_halvings();
    const float s_m = patch.width_m;
    const float t_m = patch.height_m;
    const auto width = [&] { return std::ldexp(s_m, -s_halvings); };
    const auto height = [&] { return std::ldexp(t_m, -t_halvings); };
    bool any = false;
    while (width() > 1.5f * height() && VariesAlong(face, s_halvings, true)) {
      ++s_halvings;
      any = true;
    }
    while (height() > 1.5f * width() && VariesAlong(face, t_halvings, false)) {
      ++t_halvings;
      any = true;
    }
    if (!any) return;
    grids_[face]->grid = LightGrid(patches_, face / 2, s_halvings, t_halvings);
    grids_[face]->of_corner.clear();
  }

  // Whether light along the two long borders is not linear between the ends of rectangles.
  bool VariesAlong(uint32_t face, int halvings, bool along_s) {
    const int32_t step = kGridUnits >> halvings;
    if (step < 4) return false;
    const LightPatch& patch = patches_.PatchOfFace(face);
    const float step_m = std::ldexp(along_s ? patch.width_m : patch.height_m, -halvings);
    const auto point_at = [&](int32_t along, int32_t across) {
      return PointAt(face, along_s ? GridNode{along, across} : GridNode{across, along});
    };
    for (const int32_t across : {0, kGridUnits}) {
      for (int32_t at = 0; at < kGridUnits; at += step) {
        const uint32_t a = point_at(at, across);
        const uint32_t b = point_at(at + step, across);
        const uint32_t middle = point_at(at + step / 2, across);
        if (a == kHidden || b == kHidden || middle == kHidden) continue;
        if (IsOff(middle, a, b, step_m)) return true;
      }
    }
    return false;
  }

  bool IsOff(uint32_t middle, uint32_t a, uint32_t b, float size_m) const {
    const float mean = 0.5f * (light_[a] + light_[b]);
    const float tolerated =
        kTolerance * std::max(light_[middle], mean) * std::max(1.0f, kToleranceSize_m / size_m) +
        kFloor * std::max(1.0f, kFloorSize_m / size_m);
    return std::abs(light_[middle] - mean) > tolerated;
  }

  bool MustBeHalved(uint32_t face, size_t leaf) {
    const LightPatch& patch = patches_.PatchOfFace(face);
    const LightGrid::Cell cell = grids_[face]->grid.cells()[leaf];
    const float size_m =
        glm::distance(patch.At(InPatch(cell.corners[0])), patch.At(InPatch(cell.corners[1])));
    if (size_m < kShortestLeaf_m || !cell.can_be_halved()) return false;
    std::array<uint32_t, 3> points{};
    float curvature_per_m2 = 0.0f;
    for (int k = 0; k < 3; ++k) {
      points[static_cast<size_t>(k)] = CornerPoint(face, leaf, k);
      curvature_per_m2 =
          std::max(curvature_per_m2, curvature_per_m2_[points[static_cast<size_t>(k)]]);
    }
    if (size_m * size_m / 8.0f * curvature_per_m2 < kFlat) return false;
    const uint32_t middle = PointAt(face, cell.Middle());
    if (middle == kHidden) {
      // The outline of what hides it is on the leaf, unless all of it is hidden.
      return !IsHiddenLeaf(face, cell) || size_m > kLongestHiddenLeaf_m;
    }
    return IsOff(middle, points[0], points[1], size_m);
  }

  // Whether any leaf was halved.
  bool HalveLeaves() {
    bool any = false;
    for (uint32_t face = 0; face < grids_.size(); ++face) {
      if (!grids_[face]) continue;
      FaceGrid& of_face = *grids_[face];
      of_face.is_settled.resize(of_face.grid.cells().size(), false);
      std::vector<size_t> to_halve;
      for (const size_t leaf : of_face.grid.UsedLeaves()) {
        if (of_face.is_settled[leaf]) continue;
        if (open_view_of_.size() >= most_points_) return any;
        of_face.is_settled[leaf] = true;
        if (MustBeHalved(face, leaf)) to_halve.push_back(leaf);
      }
      for (const size_t leaf : to_halve) {
        if (of_face.grid.cells()[leaf].is_leaf()) of_face.grid.Halve(leaf);
        any = true;
      }
    }
    return any;
  }

  // The corners of the triangle of a face that has normals of its own.
  std::array<BakePoint, 3> CornersOfTriangle(uint32_t face) const {
    const TriangleSoup& soup = scene_.opaque();
    const LightPatch& patch = patches_.PatchOfFace(face);
    const uint32_t triangle = patch.triangles.front();
    std::array<BakePoint, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const uint32_t vertex = soup.triangles[triangle][k];
      const vec3& shading = soup.vertex_normals_W[vertex];
      const vec3 n = glm::dot(patch.n_W, shading) < 0.0f ? -shading : shading;
      const vec3 centroid = patch.At(vec2(1.0f / 3.0f));
      corners[static_cast<size_t>(k)] = {
          glm::mix(soup.positions_W[vertex], centroid, kInwardsOfTriangle),
          LightPatches::IsFront(face) ? n : -n};
    }
    return corners;
  }

  // Triangles of a smooth surface share the points of their corners.
  std::array<uint32_t, 3> PointsOfTriangle(uint32_t face) {
    const std::array<BakePoint, 3> corners = CornersOfTriangle(face);
    const LightPatch& patch = patches_.PatchOfFace(face);
    std::array<uint32_t, 3> points{};
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t vertex =
          scene_.opaque().triangles[patch.triangles.front()][static_cast<glm::length_t>(k)];
      const auto [entry, is_new] =
          of_vertex_.try_emplace({vertex, patch.surface, LightPatches::IsFront(face)}, kNoPoint);
      if (is_new) {
        const vec3 centroid = patch.At(vec2(1.0f / 3.0f));
        BakePoint place = corners[k];
        for (const float part : {0.1f, 0.35f, 1.0f}) {
          if (!IsHidden(face, place)) break;
          place.p_W = glm::mix(corners[k].p_W, centroid, part);
        }
        entry->second = AddPoint(caster_.From(place));
      }
      points[k] = entry->second;
    }
    return points;
  }

  // Calls f(face) for all faces of one triangle that has normals of its own.
  template <typename Function>
  void ForEachSmoothFace(const Function& f) const {
    for (uint32_t face = 0; face < patches_.face_count(); ++face) {
      const LightPatch& patch = patches_.PatchOfFace(face);
      if (patch.is_smooth && (LightPatches::IsFront(face) || patch.has_back)) f(face);
    }
  }

  // Calls f(face, node) for the corners of all used leaves, of each grid as they are.
  template <typename Function>
  void ForEachNode(const Function& f) const {
    for (uint32_t face = 0; face < grids_.size(); ++face) {
      if (!grids_[face]) continue;
      const LightGrid& grid = grids_[face]->grid;
      for (const size_t leaf : grid.UsedLeaves()) {
        for (const GridNode& node : grid.cells()[leaf].corners) f(face, node);
      }
    }
  }

  size_t CountFirstPoints() const {
    size_t count = 0;
    // In a grid a node has about two triangles, on a smooth surface too.
    ForEachNode([&](uint32_t, const GridNode&) { ++count; });
    ForEachSmoothFace([&](uint32_t) { count += 3; });
    return count / 3;
  }

  // Looks from a few of the first grids' nodes alone.
  void ShareFirstPoints() {
    std::vector<BakePoint> places;
    ForEachNode([&](uint32_t face, const GridNode& node) {
      places.push_back(PlaceOf(face, InPatch(node)));
    });
    ForEachSmoothFace([&](uint32_t face) {
      for (const BakePoint& corner : CornersOfTriangle(face)) places.push_back(corner);
    });
    const std::vector<size_t> shared = SharedPoints(places, most_points_);
    std::vector<uint32_t> points(places.size(), kNoPoint);
    for (size_t i = 0; i < places.size(); ++i) {
      points[i] = shared[i] == i ? AddPoint(caster_.From(places[i])) : points[shared[i]];
    }
    size_t next = 0;
    ForEachNode([&](uint32_t face, const GridNode& node) {
      const uint64_t key = (static_cast<uint64_t>(node.s) << 32) | static_cast<uint64_t>(node.t);
      grids_[face]->of_node.emplace(key, points[next++]);
    });
    ForEachSmoothFace([&](uint32_t face) {
      const LightPatch& patch = patches_.PatchOfFace(face);
      for (int k = 0; k < 3; ++k) {
        const uint32_t vertex = scene_.opaque().triangles[patch.triangles.front()][k];
        of_vertex_.emplace(std::tuple(vertex, patch.surface, LightPatches::IsFront(face)),
                           points[next++]);
      }
    });
  }

  // All leaves as they are now; makes the points that are still missing.
  LightLeaves Leaves() {
    LightLeaves all(patches_.face_count());
    for (uint32_t face = 0; face < patches_.face_count(); ++face) {
      const LightPatch& patch = patches_.PatchOfFace(face);
      LightLeaves::Leaf whole{.face = face,
                              .corners = {vec2(0.0f, 0.0f), vec2(1.0f, 0.0f), vec2(0.0f, 1.0f)}};
      if (open_points_[face] != kNoPoint) {
        whole.points.fill(open_points_[face]);
        all.Add(face, whole);
      } else if (patch.is_smooth && (LightPatches::IsFront(face) || patch.has_back)) {
        whole.points = PointsOfTriangle(face);
        all.Add(face, whole);
      } else if (grids_[face]) {
        std::vector<LightLeaves::Leaf> leaves;
        for (const size_t leaf : grids_[face]->grid.UsedLeaves()) {
          LightLeaves::Leaf& added = leaves.emplace_back();
          added.face = face;
          for (int k = 0; k < 3; ++k) {
            const auto corner = static_cast<size_t>(k);
            added.corners[corner] = InPatch(grids_[face]->grid.cells()[leaf].corners[corner]);
            added.points[corner] = CornerPoint(face, leaf, k);
          }
        }
        all.Add(face, grids_[face]->grid, leaves);
      }
    }
    return all;
  }

  const TracedScene& scene_;
  size_t most_points_;
  LightPatches patches_;
  LightElements elements_;
  HemisphereCaster caster_;
  std::vector<std::optional<FaceGrid>> grids_;
  std::vector<uint32_t> open_points_;  // Of faces that have one point.
  std::map<std::tuple<uint32_t, uint32_t, bool>, uint32_t> of_vertex_;

  std::vector<uint32_t> open_view_of_;
  std::vector<OpenView> open_views_;
  std::vector<size_t> first_factor_;
  std::vector<FormFactor> factors_;

  // Of each point: what decides where more are needed.
  std::vector<float> curvature_per_m2_;
  std::vector<float> open_light_;
  std::vector<float> light_;
  std::vector<float> exitances_;  // Of each element, once the first leaves are solved.
  LightLeaves solved_leaves_{0};
  bool is_solved_ = false;
};

}  // namespace

LightBake BakeLight(const TracedScene& scene, const std::vector<uint32_t>& surfaces,
                    size_t most_points) {
  return Baker(scene, surfaces, most_points).Bake();
}

}  // namespace fenestra
