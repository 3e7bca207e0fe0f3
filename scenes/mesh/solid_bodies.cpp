#include "scenes/mesh/solid_bodies.h"

#include <cmath>
#include <numbers>

#include "core/system/check.h"

namespace fenestra {
namespace {

using Eigen::Vector3d;

glm::vec3 ToGlm(const Vector3d& v) {
  const Eigen::Vector3f f = v.cast<float>();
  return {f.x(), f.y(), f.z()};
}

uint32_t AddVertex(const Vector3d& p_W, Mesh& mesh) {
  mesh.positions_W.push_back(ToGlm(p_W));
  return static_cast<uint32_t>(mesh.positions_W.size() - 1);
}

// Position in a cuboid, in half axes. Corners that faces share come out equal, to the bit.
Vector3d At(const Cuboid& cuboid, const Vector3d& abc) {
  return cuboid.centre_W + abc.x() * cuboid.half_x + abc.y() * cuboid.half_y +
         abc.z() * cuboid.half_z;
}

// The face with corners centre ± u ± v in half axes, cut across v; it looks towards u x v.
void AddFace(const Cuboid& cuboid, const Vector3d& centre, const Vector3d& u, const Vector3d& v,
             int slices, Mesh& mesh) {
  uint32_t left = 0;
  uint32_t right = 0;
  for (int i = 0; i <= slices; ++i) {
    const Vector3d across = centre + (2.0 * i / slices - 1.0) * v;
    const uint32_t next_left = AddVertex(At(cuboid, across - u), mesh);
    const uint32_t next_right = AddVertex(At(cuboid, across + u), mesh);
    if (i > 0) {
      mesh.triangles.emplace_back(left, right, next_right);
      mesh.triangles.emplace_back(left, next_right, next_left);
    }
    left = next_left;
    right = next_right;
  }
}

// Directions across a bar at one of its points.
struct Ring {
  Vector3d centre_W;
  Vector3d u;
  Vector3d v;
};

// u lies in the facade's plane and v is perpendicular to u and to the bar, so that u x v points
// along the path.
Ring RingAt(const std::vector<Vector3d>& path_W, size_t i) {
  const Vector3d& before = path_W[i > 0 ? i - 1 : 0];
  const Vector3d& after = path_W[i + 1 < path_W.size() ? i + 1 : i];
  const Vector3d along = (after - before).normalized();
  const Vector3d u = Vector3d::UnitZ().cross(along).normalized();
  return {path_W[i], u, along.cross(u)};
}

// Closes a bar at the ring that begins with vertex `first`.
void AddCap(uint32_t first, int sides, bool at_end, const Vector3d& normal, Mesh& mesh) {
  const auto base = static_cast<uint32_t>(mesh.positions_W.size());
  for (uint32_t k = 0; k < static_cast<uint32_t>(sides); ++k) {
    const glm::vec3 position = mesh.positions_W[first + k];
    mesh.positions_W.push_back(position);
    mesh.normals_W.push_back(ToGlm(normal));
  }
  for (uint32_t k = 1; k + 1 < static_cast<uint32_t>(sides); ++k) {
    glm::uvec3 triangle(base, base + k, base + k + 1);
    if (!at_end) std::swap(triangle.y, triangle.z);
    mesh.triangles.push_back(triangle);
  }
}

}  // namespace

Cuboid CuboidOf(const Box& box) {
  const Vector3d half = 0.5 * (box.high - box.low);
  return {.centre_W = 0.5 * (box.low + box.high),
          .half_x = {half.x(), 0.0, 0.0},
          .half_y = {0.0, half.y(), 0.0},
          .half_z = {0.0, 0.0, half.z()}};
}

void AddCuboid(const Cuboid& cuboid, int slices, Mesh& mesh) {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  AddFace(cuboid, z, x, y, slices, mesh);
  AddFace(cuboid, -z, -x, y, slices, mesh);
  AddFace(cuboid, x, -z, y, slices, mesh);
  AddFace(cuboid, -x, z, y, slices, mesh);
  AddFace(cuboid, y, x, -z, 1, mesh);
  AddFace(cuboid, -y, x, z, 1, mesh);
}

void AddBar(const std::vector<Vector3d>& path_W, double radius_m, int sides, Mesh& mesh) {
  FENESTRA_CHECK(path_W.size() >= 2 && sides >= 3, "a bar needs two ends and three sides");
  FENESTRA_CHECK(mesh.normals_W.size() == mesh.positions_W.size(), "bars have normals");
  const auto n = static_cast<uint32_t>(sides);
  const auto base = static_cast<uint32_t>(mesh.positions_W.size());
  for (size_t i = 0; i < path_W.size(); ++i) {
    const Ring ring = RingAt(path_W, i);
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      const Vector3d out = std::cos(angle) * ring.u + std::sin(angle) * ring.v;
      AddVertex(ring.centre_W + radius_m * out, mesh);
      mesh.normals_W.push_back(ToGlm(out));
    }
  }
  const auto rings = static_cast<uint32_t>(path_W.size());
  for (uint32_t i = 0; i + 1 < rings; ++i) {
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t a = base + i * n + k;
      const uint32_t b = base + i * n + (k + 1) % n;
      mesh.triangles.emplace_back(a, b, b + n);
      mesh.triangles.emplace_back(a, b + n, a + n);
    }
  }
  const Vector3d first = (path_W[1] - path_W[0]).normalized();
  const Vector3d last = (path_W[rings - 1] - path_W[rings - 2]).normalized();
  AddCap(base, sides, false, -first, mesh);
  AddCap(base + (rings - 1) * n, sides, true, last, mesh);
}

}  // namespace fenestra
