#include "scenes/mesh/longest_edge_bisection.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_map>
#include <utility>

namespace fenestra {
namespace {

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
