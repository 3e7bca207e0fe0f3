#include "scenes/mesh/tessellation.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace fenestra {
namespace {

// The middle of two neighbouring floats is one of them: such an edge cannot be halved.
bool CanBeHalved(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 middle = 0.5f * a + 0.5f * b;
  return middle != a && middle != b;
}

double SquaredLength(const glm::vec3& a, const glm::vec3& b) {
  const glm::dvec3 along = glm::dvec3(b) - glm::dvec3(a);
  return glm::dot(along, along);
}

// Halves triangles of one mesh at their longest edges.
class MeshSplitter {
 public:
  explicit MeshSplitter(Mesh& mesh) : mesh_(mesh) {}

  /// 0 where the longest edge cannot be halved.
  double LongestSquared(size_t triangle) const {
    const glm::uvec3& t = mesh_.triangles[triangle];
    const int k = LongestOf(t);
    const glm::vec3& a = mesh_.positions_W[t[k]];
    const glm::vec3& b = mesh_.positions_W[t[(k + 1) % 3]];
    return CanBeHalved(a, b) ? SquaredLength(a, b) : 0.0;
  }

  /// One half takes the triangle's place, the other becomes the last triangle.
  void Halve(size_t triangle) {
    const glm::uvec3 t = mesh_.triangles[triangle];
    const int k = LongestOf(t);
    const uint32_t a = t[k];
    const uint32_t b = t[(k + 1) % 3];
    const uint32_t c = t[(k + 2) % 3];
    const uint32_t m = Middle(a, b);
    mesh_.triangles[triangle] = {a, m, c};
    mesh_.triangles.emplace_back(m, b, c);
  }

 private:
  int LongestOf(const glm::uvec3& t) const {
    int longest = 0;
    double longest_sq = -1.0;
    for (int k = 0; k < 3; ++k) {
      const double sq = SquaredLength(mesh_.positions_W[t[k]], mesh_.positions_W[t[(k + 1) % 3]]);
      if (sq > longest_sq) {
        longest = k;
        longest_sq = sq;
      }
    }
    return longest;
  }

  uint32_t Middle(uint32_t a, uint32_t b) {
    const auto [entry, is_new] =
        middles_.try_emplace(std::minmax(a, b), static_cast<uint32_t>(mesh_.positions_W.size()));
    if (is_new) {
      AppendMean(mesh_.positions_W, a, b);
      AppendMean(mesh_.texture_coordinates, a, b);
      AppendMean(mesh_.colors, a, b);
      AppendMean(mesh_.normals_W, a, b);
      if (!mesh_.normals_W.empty()) mesh_.normals_W.back() = Unit(mesh_.normals_W.back(), a);
    }
    return entry->second;
  }

  template <typename T>
  static void AppendMean(std::vector<T>& values, uint32_t a, uint32_t b) {
    if (!values.empty()) values.push_back(0.5f * values[a] + 0.5f * values[b]);
  }

  // The mean of opposite normals has no direction; either will do.
  glm::vec3 Unit(const glm::vec3& mean, uint32_t a) const {
    const float length = glm::length(mean);
    return length > 1e-3f ? mean / length : mesh_.normals_W[a];
  }

  Mesh& mesh_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles_;
};

// A triangle that waits for being halved; the one with the longest edge is first.
struct Halvable {
  double longest_sq;
  size_t mesh;
  size_t triangle;

  bool operator<(const Halvable& other) const {
    return std::tie(longest_sq, other.mesh, other.triangle) <
           std::tie(other.longest_sq, mesh, triangle);
  }
};

constexpr uint32_t kWhole = std::numeric_limits<uint32_t>::max();

using Allowed = std::function<double(const glm::vec3&)>;

struct Edge {
  uint32_t a;
  uint32_t b;
  double squared_length;
  bool can_be_halved;
  bool marked = false;       // To be split.
  uint32_t middle = kWhole;  // Its position, once it is split.
};

// The edges of a surface as it is now; corner k and the next corner make edge k of a triangle.
class EdgeTable {
 public:
  EdgeTable(const SolidSurface& surface, const Allowed& longest_edge_m)
      : surface_(surface), longest_edge_m_(longest_edge_m) {}

  // Makes the edges of new triangles and marks those that are too long. An edge is judged once.
  void Update() {
    of_triangle_.clear();
    for (const SolidSurface::Triangle& t : surface_.triangles) {
      std::array<uint32_t, 3> edges{};
      for (int k = 0; k < 3; ++k) {
        edges[static_cast<size_t>(k)] = IndexOf(t.corners[k], t.corners[(k + 1) % 3]);
      }
      of_triangle_.push_back(edges);
    }
  }

  std::vector<Edge>& edges() { return edges_; }
  Edge& EdgeOf(size_t triangle, int k) {
    return edges_[of_triangle_[triangle][static_cast<size_t>(k % 3)]];
  }
  glm::vec3 MiddleOf(const Edge& edge) const {
    return 0.5f * (surface_.positions_W[edge.a] + surface_.positions_W[edge.b]);
  }

  // The first of the longest edges.
  int LongestOf(size_t triangle) {
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (EdgeOf(triangle, k).squared_length > EdgeOf(triangle, longest).squared_length) {
        longest = k;
      }
    }
    return longest;
  }

 private:
  uint32_t IndexOf(uint32_t a, uint32_t b) {
    if (a > b) std::swap(a, b);
    const uint64_t key = (static_cast<uint64_t>(a) << 32) | b;
    const auto [entry, is_new] = index_.try_emplace(key, static_cast<uint32_t>(edges_.size()));
    if (is_new) {
      const glm::vec3& p_a = surface_.positions_W[a];
      const glm::vec3& p_b = surface_.positions_W[b];
      Edge edge{.a = a,
                .b = b,
                .squared_length = SquaredLength(p_a, p_b),
                .can_be_halved = CanBeHalved(p_a, p_b)};
      const double allowed_m = longest_edge_m_(MiddleOf(edge));
      edge.marked = edge.can_be_halved && edge.squared_length > allowed_m * allowed_m;
      edges_.push_back(edge);
    }
    return entry->second;
  }

  const SolidSurface& surface_;
  const Allowed& longest_edge_m_;
  std::vector<Edge> edges_;
  std::vector<std::array<uint32_t, 3>> of_triangle_;
  std::unordered_map<uint64_t, uint32_t> index_;
};

// A triangle of which any edge is split is split at its longest edge too.
void MarkLongestOfMarked(const SolidSurface& surface, EdgeTable& table) {
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
      Edge& longest = table.EdgeOf(t, table.LongestOf(t));
      if (longest.marked || !longest.can_be_halved) continue;
      for (int k = 0; k < 3; ++k) longest.marked |= table.EdgeOf(t, k).marked;
      changed |= longest.marked;
    }
  }
}

void SplitTriangle(const SolidSurface::Triangle& triangle, size_t index, EdgeTable& table,
                   std::vector<SolidSurface::Triangle>& out) {
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    out.push_back({{a, b, c}, triangle.solid, triangle.facing});
  };
  const int k = table.LongestOf(index);
  const uint32_t middle = table.EdgeOf(index, k).middle;
  if (middle == kWhole) {
    out.push_back(triangle);
    return;
  }
  const uint32_t a = triangle.corners[k];
  const uint32_t b = triangle.corners[(k + 1) % 3];
  const uint32_t c = triangle.corners[(k + 2) % 3];
  const uint32_t of_bc = table.EdgeOf(index, k + 1).middle;
  const uint32_t of_ca = table.EdgeOf(index, k + 2).middle;
  if (of_bc == kWhole) {
    add(middle, b, c);
  } else {
    add(middle, b, of_bc);
    add(middle, of_bc, c);
  }
  if (of_ca == kWhole) {
    add(middle, c, a);
  } else {
    add(middle, c, of_ca);
    add(middle, of_ca, a);
  }
}

}  // namespace

Scene Tessellated(Scene scene, size_t triangles) {
  size_t count = 0;
  for (const Mesh& mesh : scene.meshes) count += mesh.closed ? 0 : mesh.triangles.size();
  if (count >= triangles) return scene;

  std::vector<MeshSplitter> splitters;
  std::priority_queue<Halvable> waiting;
  const auto wait = [&](size_t mesh, size_t triangle) {
    const double longest_sq = splitters[mesh].LongestSquared(triangle);
    if (longest_sq > 0.0) waiting.push({longest_sq, mesh, triangle});
  };
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    splitters.emplace_back(scene.meshes[m]);
    if (scene.meshes[m].closed) continue;
    for (size_t t = 0; t < scene.meshes[m].triangles.size(); ++t) wait(m, t);
  }
  // The neighbours of an edge have it halved too: no edge that is as long as it may stay.
  double last_sq = 0.0;
  while (!waiting.empty() && count < 2 * triangles) {
    const Halvable longest = waiting.top();
    if (count >= triangles && longest.longest_sq < last_sq) break;
    waiting.pop();
    last_sq = longest.longest_sq;
    splitters[longest.mesh].Halve(longest.triangle);
    ++count;
    wait(longest.mesh, longest.triangle);
    wait(longest.mesh, scene.meshes[longest.mesh].triangles.size() - 1);
  }
  return scene;
}

void BisectLongEdges(SolidSurface& surface,
                     const std::function<double(const glm::vec3&)>& longest_edge_m) {
  EdgeTable table(surface, longest_edge_m);
  for (bool any = true; any;) {
    table.Update();
    MarkLongestOfMarked(surface, table);
    any = false;
    for (Edge& edge : table.edges()) {
      if (!edge.marked || edge.middle != kWhole) continue;
      edge.middle = static_cast<uint32_t>(surface.positions_W.size());
      surface.positions_W.push_back(table.MiddleOf(edge));
      any = true;
    }
    std::vector<SolidSurface::Triangle> split;
    split.reserve(2 * surface.triangles.size());
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
      SplitTriangle(surface.triangles[t], t, table, split);
    }
    surface.triangles = std::move(split);
  }
}

}  // namespace fenestra
