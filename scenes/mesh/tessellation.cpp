#include "scenes/mesh/tessellation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

class MeshSplitter {
 public:
  MeshSplitter(const Mesh& mesh, double longest_edge_m)
      : longest_sq_(longest_edge_m * longest_edge_m), mesh_(mesh) {
    mesh_.triangles.clear();
    for (const glm::uvec3& triangle : mesh.triangles) Split(triangle);
  }

  Mesh Take() { return std::move(mesh_); }

 private:
  double LengthSquared(uint32_t a, uint32_t b) const {
    const glm::dvec3 edge = glm::dvec3(mesh_.positions_W[a]) - glm::dvec3(mesh_.positions_W[b]);
    return glm::dot(edge, edge);
  }

  void Split(const glm::uvec3& triangle) {
    std::vector<glm::uvec3> open = {triangle};
    while (!open.empty()) {
      const glm::uvec3 t = open.back();
      open.pop_back();
      int longest = 0;
      for (int k = 1; k < 3; ++k) {
        if (LengthSquared(t[k], t[(k + 1) % 3]) > LengthSquared(t[longest], t[(longest + 1) % 3])) {
          longest = k;
        }
      }
      const uint32_t a = t[longest];
      const uint32_t b = t[(longest + 1) % 3];
      const uint32_t c = t[(longest + 2) % 3];
      if (LengthSquared(a, b) <= longest_sq_) {
        mesh_.triangles.push_back(t);
        continue;
      }
      const uint32_t m = Middle(a, b);
      open.emplace_back(m, b, c);
      open.emplace_back(a, m, c);
    }
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
    if (!values.empty()) values.push_back(0.5f * (values[a] + values[b]));
  }

  // The mean of opposite normals has no direction; either will do.
  glm::vec3 Unit(const glm::vec3& mean, uint32_t a) const {
    const float length = glm::length(mean);
    return length > 1e-3f ? mean / length : mesh_.normals_W[a];
  }

  double longest_sq_;
  Mesh mesh_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles_;
};

double Area(const Mesh& mesh) {
  double area_m2 = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions_W[t.x];
    area_m2 += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions_W[t.y]) - a,
                                            glm::dvec3(mesh.positions_W[t.z]) - a));
  }
  return area_m2;
}

constexpr uint32_t kWhole = std::numeric_limits<uint32_t>::max();

using Allowed = std::function<double(const glm::vec3&)>;

struct Edge {
  uint32_t a;
  uint32_t b;
  double squared_length;
  bool marked;               // To be split.
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
      const glm::dvec3 along =
          glm::dvec3(surface_.positions_W[b]) - glm::dvec3(surface_.positions_W[a]);
      Edge edge{.a = a, .b = b, .squared_length = glm::dot(along, along), .marked = false};
      const double allowed_m = longest_edge_m_(MiddleOf(edge));
      edge.marked = edge.squared_length > allowed_m * allowed_m;
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
      if (longest.marked) continue;
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

Scene Tessellated(const Scene& scene, double longest_edge_m) {
  if (!(longest_edge_m > 0.0)) {
    throw InputError("tessellation",
                     fmt::format("the longest edge must be positive, not {} m", longest_edge_m));
  }
  Scene result = scene;
  if (std::isinf(longest_edge_m)) return result;
  for (Mesh& mesh : result.meshes) {
    if (!mesh.closed) mesh = MeshSplitter(mesh, longest_edge_m).Take();
  }
  return result;
}

double EdgeForTriangles(const Scene& scene, size_t triangles) {
  double area_m2 = 0.0;
  size_t count = 0;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.closed) continue;
    area_m2 += Area(mesh);
    count += mesh.triangles.size();
  }
  if (count >= triangles) return std::numeric_limits<double>::infinity();
  // Halved right triangles have an area of about a fourth of their longest edge squared.
  const double each_m2 = area_m2 / static_cast<double>(triangles - count);
  return area_m2 > 0.0 ? std::sqrt(4.0 * each_m2) : std::numeric_limits<double>::infinity();
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
