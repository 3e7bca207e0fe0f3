#include "renderers/tracing/triangle_soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tuple>

namespace fenestra {
namespace {

void AppendVertices(const Mesh& mesh, TriangleSoup& soup) {
  const size_t count = mesh.positions_W.size();
  const auto append = [count](auto& to, const auto& from, auto missing) {
    if (from.empty()) {
      to.resize(to.size() + count, missing);
    } else {
      to.insert(to.end(), from.begin(), from.end());
    }
  };
  append(soup.positions_W, mesh.positions_W, glm::vec3(0.0f));
  append(soup.texture_coordinates, mesh.texture_coordinates, glm::vec2(0.0f));
  append(soup.colors, mesh.colors, glm::vec3(1.0f));
  append(soup.vertex_normals_W, mesh.normals_W, glm::vec3(0.0f));
}

void AppendTriangles(const Mesh& mesh, uint32_t mesh_index, uint32_t base, TriangleSoup& soup) {
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions_W[t.x];
    const glm::dvec3 cross =
        glm::cross(glm::dvec3(mesh.positions_W[t.y]) - a, glm::dvec3(mesh.positions_W[t.z]) - a);
    const double length = glm::length(cross);
    if (!(length > 0.0)) continue;
    soup.triangles.push_back(t + base);
    soup.mesh_of.push_back(mesh_index);
    soup.is_closed.push_back(mesh.closed);
    soup.normals_W.push_back(glm::vec3(cross / length));
  }
}

bool HasHoles(const Scene& scene, const Mesh& mesh) {
  const Material& material = scene.materials[mesh.material];
  return material.alpha_cutoff > 0.0f && material.texture && !mesh.texture_coordinates.empty();
}

// Sets of triangles that belong together.
class Groups {
 public:
  explicit Groups(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  uint32_t Find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(uint32_t a, uint32_t b) {
    a = Find(a);
    b = Find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parent_;
};

void JoinPlanes(const TriangleSoup& soup, Groups& groups) {
  constexpr double kNormalStep = 1e-4;
  constexpr double kDistanceStep_m = 1e-4;
  const auto rounded = [](double value, double step) {
    return static_cast<int64_t>(std::llround(value / step));
  };
  std::map<std::array<int64_t, 5>, uint32_t> first;
  for (uint32_t i = 0; i < soup.size(); ++i) {
    if (soup.is_smooth(i)) continue;
    const glm::dvec3 n = soup.normals_W[i];
    const double distance_m = glm::dot(n, glm::dvec3(soup.positions_W[soup.triangles[i].x]));
    const std::array<int64_t, 5> plane = {soup.mesh_of[i], rounded(n.x, kNormalStep),
                                          rounded(n.y, kNormalStep), rounded(n.z, kNormalStep),
                                          rounded(distance_m, kDistanceStep_m)};
    groups.Join(first.try_emplace(plane, i).first->second, i);
  }
}

void JoinSmoothNeighbours(const TriangleSoup& soup, Groups& groups) {
  using Corner = std::tuple<float, float, float, float, float, float>;
  const auto corner_of = [&soup](uint32_t vertex) {
    const glm::vec3& p = soup.positions_W[vertex];
    const glm::vec3& n = soup.vertex_normals_W[vertex];
    return Corner(p.x, p.y, p.z, n.x, n.y, n.z);
  };
  std::map<std::tuple<uint32_t, Corner, Corner>, uint32_t> first;
  for (uint32_t i = 0; i < soup.size(); ++i) {
    if (!soup.is_smooth(i)) continue;
    for (int k = 0; k < 3; ++k) {
      Corner a = corner_of(soup.triangles[i][k]);
      Corner b = corner_of(soup.triangles[i][(k + 1) % 3]);
      if (b < a) std::swap(a, b);
      groups.Join(first.try_emplace({soup.mesh_of[i], a, b}, i).first->second, i);
    }
  }
}

// The same number for equal positions.
std::vector<uint32_t> Welded(const std::vector<glm::vec3>& positions) {
  std::vector<uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&positions](uint32_t i) {
    const glm::vec3& p = positions[i];
    return std::make_tuple(p.x, p.y, p.z);
  };
  std::ranges::sort(order, {}, key);
  std::vector<uint32_t> number(positions.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && key(order[i]) == key(order[i - 1]);
    number[order[i]] = is_same ? number[order[i - 1]] : order[i];
  }
  return number;
}

// An edge of one triangle, from its lower to its higher position or back.
struct HalfEdge {
  uint32_t low;
  uint32_t high;
  int direction;
  uint32_t triangle;
};

std::vector<HalfEdge> SortedHalfEdges(const TriangleSoup& soup) {
  const std::vector<uint32_t> number = Welded(soup.positions_W);
  std::vector<HalfEdge> edges;
  edges.reserve(3 * soup.size());
  for (uint32_t t = 0; t < soup.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = number[soup.triangles[t][k]];
      const uint32_t b = number[soup.triangles[t][(k + 1) % 3]];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1, t});
    }
  }
  std::ranges::sort(edges, {},
                    [](const HalfEdge& e) { return std::tie(e.low, e.high, e.triangle); });
  return edges;
}

}  // namespace

TriangleSoup MakeTriangleSoup(const Scene& scene, Material::Kind kind) {
  TriangleSoup soup;
  for (const bool with_holes : {false, true}) {
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
      const Mesh& mesh = scene.meshes[m];
      if (scene.materials[mesh.material].kind != kind) continue;
      if (HasHoles(scene, mesh) != with_holes) continue;
      const auto base = static_cast<uint32_t>(soup.positions_W.size());
      AppendVertices(mesh, soup);
      AppendTriangles(mesh, static_cast<uint32_t>(m), base, soup);
    }
    if (!with_holes) soup.solid_count = soup.size();
  }
  return soup;
}

std::vector<uint32_t> NumberSurfaces(const TriangleSoup& soup) {
  Groups groups(soup.size());
  JoinPlanes(soup, groups);
  JoinSmoothNeighbours(soup, groups);
  std::vector<uint32_t> numbers(soup.size());
  uint32_t count = 0;
  for (uint32_t i = 0; i < soup.size(); ++i) {
    const uint32_t root = groups.Find(i);  // The first of its group.
    numbers[i] = root == i ? count++ : numbers[root];
  }
  return numbers;
}

std::vector<bool> BoundBodies(const TriangleSoup& soup) {
  const std::vector<HalfEdge> edges = SortedHalfEdges(soup);
  Groups components(soup.size());
  std::vector<bool> at_border(soup.size(), false);
  for (size_t first = 0, end = 0; first < edges.size(); first = end) {
    int balance = 0;
    for (end = first; end < edges.size() && edges[end].low == edges[first].low &&
                      edges[end].high == edges[first].high;
         ++end) {
      balance += edges[end].direction;
    }
    for (size_t i = first; i < end; ++i) {
      if (balance != 0) at_border[edges[i].triangle] = true;
      if (balance == 0) components.Join(edges[first].triangle, edges[i].triangle);
    }
  }
  // Volumes are those of the tetrahedra between the triangles and a corner of their component.
  std::vector<double> six_volumes(soup.size(), 0.0);
  std::vector<bool> has_border(soup.size(), false);
  for (uint32_t t = 0; t < soup.size(); ++t) {
    const uint32_t root = components.Find(t);
    const glm::dvec3 origin = soup.positions_W[soup.triangles[root].x];
    std::array<glm::dvec3, 3> p;
    for (int k = 0; k < 3; ++k) {
      p[static_cast<size_t>(k)] = glm::dvec3(soup.positions_W[soup.triangles[t][k]]) - origin;
    }
    six_volumes[root] += glm::dot(p[0], glm::cross(p[1], p[2]));
    if (at_border[t]) has_border[root] = true;
  }
  std::vector<bool> bounds(soup.size());
  for (uint32_t t = 0; t < soup.size(); ++t) {
    const uint32_t root = components.Find(t);
    bounds[t] = soup.is_closed[t] || (!has_border[root] && six_volumes[root] > 0.0);
  }
  return bounds;
}

}  // namespace fenestra
