#include "renderers/sky_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "renderers/hemisphere.h"

namespace fenestra {
namespace {

using glm::vec3;

// Transmittances that differ by more than this end differently; what a pane does varies less.
constexpr float kSameTransmittance = 0.1f;
// Corners are moved this part of the way into their faces: on the edge itself, a ray into the
// neighbouring solid would start on that solid's surface and might miss it.
constexpr float kInwards = 0.02f;

// One side of a surface at a corner.
struct BakePoint {
  vec3 p_W{0.0f};
  vec3 n_W{0.0f};
};

// What a ray into the open has found.
struct Ending {
  float transmittance = 0.0f;
  bool in_sky = false;

  bool DiffersFrom(const Ending& other) const {
    const bool blocked = transmittance == 0.0f && other.transmittance == 0.0f;
    return (in_sky != other.in_sky && !blocked) ||
           std::abs(transmittance - other.transmittance) > kSameTransmittance;
  }
};

// Weighted mean transmittances towards the sky and towards the ground.
class ViewTally {
 public:
  void Add(const Ending& ending, float weight) {
    Part& part = ending.in_sky ? sky_ : ground_;
    part.sum += weight * ending.transmittance;
    part.weight += weight;
  }
  SkyView OfUnobstructed(const SkyView& view) const {
    return {.sky = view.sky * sky_.Mean(), .ground = view.ground * ground_.Mean()};
  }

 private:
  struct Part {
    float sum = 0.0f;
    float weight = 0.0f;
    float Mean() const { return weight > 0.0f ? sum / weight : 0.0f; }
  };
  Part sky_;
  Part ground_;
};

SkyView Unobstructed(const vec3& n) {
  return {.sky = 0.5f * (1.0f + n.y), .ground = 0.5f * (1.0f - n.y)};
}

class Baker {
 public:
  explicit Baker(const TracedScene& scene)
      : scene_(scene),
        offset_m_(scene.SurfaceOffset(vec3(0.0f))),
        directions_(MakeHemisphereDirections()) {}

  SkyView ViewFrom(const BakePoint& point) const {
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
    return tally.OfUnobstructed(Unobstructed(point.n_W));
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

  std::array<Ending, kLanes> Cast(const BakePoint& point, const DirectionSquare& square) const {
    // A horizontal tangent keeps the pattern upright.
    const vec3 n = point.n_W;
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
    RayPacket packet;
    SetRays(packet, point.p_W + offset_m_ * n, soa);
    const Lanes<float> passed =
        scene_.Transmittance(FirstLanes(kLanes), packet.ray, Coherence::kCoherent);
    std::array<Ending, kLanes> endings;
    for (int i = 0; i < kLanes; ++i) {
      endings[static_cast<size_t>(i)] = {.transmittance = passed[i], .in_sky = soa.y[i] > 0.0f};
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

// Corners of faces in one plane that share a vertex share their view.
struct SharedCorner {
  vec3 p_W{0.0f};
  vec3 n_W{0.0f};
  vec3 centroid_sum_W{0.0f};
  float count = 0.0f;
  uint32_t plane = 0;
  bool is_closed = false;

  BakePoint Side(bool front) const {
    const vec3 centroid = centroid_sum_W / count;
    return {p_W + kInwards * (centroid - p_W), front ? n_W : -n_W};
  }
};

struct SharedCorners {
  std::vector<SharedCorner> corners;
  std::vector<std::array<size_t, 3>> of_triangle;
};

SharedCorners FindSharedCorners(const TriangleSoup& soup) {
  const std::vector<uint32_t> planes = NumberPlanes(soup);
  SharedCorners shared;
  std::map<std::pair<uint32_t, uint32_t>, size_t> index;
  for (size_t t = 0; t < soup.size(); ++t) {
    std::array<size_t, 3> ids{};
    vec3 centroid(0.0f);
    for (int k = 0; k < 3; ++k) centroid += soup.positions_W[soup.triangles[t][k]] / 3.0f;
    for (int k = 0; k < 3; ++k) {
      const uint32_t vertex = soup.triangles[t][k];
      const auto [entry, is_new] = index.try_emplace({vertex, planes[t]}, shared.corners.size());
      if (is_new) {
        shared.corners.push_back({.p_W = soup.positions_W[vertex],
                                  .n_W = soup.normals_W[t],
                                  .plane = planes[t],
                                  .is_closed = soup.is_closed[t]});
      }
      SharedCorner& corner = shared.corners[entry->second];
      corner.centroid_sum_W += centroid;
      corner.count += 1.0f;
      ids[static_cast<size_t>(k)] = entry->second;
    }
    shared.of_triangle.push_back(ids);
  }
  return shared;
}

// The views of a corner's front and back.
std::vector<std::array<SkyView, 2>> BakeCorners(const TracedScene& scene,
                                                const std::vector<SharedCorner>& corners) {
  const Baker baker(scene);
  std::map<std::pair<uint32_t, bool>, bool> supporting;  // Of each plane's two sides.
  std::vector<std::array<SkyView, 2>> views(corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    for (const bool front : {true, false}) {
      if (!front && corners[i].is_closed) continue;
      const BakePoint point = corners[i].Side(front);
      const auto [open, is_new] = supporting.try_emplace({corners[i].plane, front}, false);
      if (is_new) open->second = IsSupportingPlane(scene, point.p_W, point.n_W);
      views[i][front ? 0 : 1] = open->second ? Unobstructed(point.n_W) : baker.ViewFrom(point);
    }
  }
  return views;
}

}  // namespace

std::vector<TriangleSkyView> BakeSkyViews(const TracedScene& scene) {
  const SharedCorners shared = FindSharedCorners(scene.opaque());
  const auto views = BakeCorners(scene, shared.corners);
  std::vector<TriangleSkyView> of_sides;
  of_sides.reserve(2 * shared.of_triangle.size());
  for (const std::array<size_t, 3>& ids : shared.of_triangle) {
    for (const size_t side : {size_t{0}, size_t{1}}) {
      of_sides.push_back({views[ids[0]][side], views[ids[1]][side], views[ids[2]][side]});
    }
  }
  return of_sides;
}

}  // namespace fenestra
