#pragma once

#include <Eigen/Core>
#include <vector>

#include "scenes/mesh/solid_lattice.h"
#include "scenes/scene.h"

namespace fenestra {

/// A cuboid of any orientation: all points centre + a half_x + b half_y + c half_z with a, b, c in
/// [-1, 1]. The half axes are perpendicular and right-handed.
struct Cuboid {
  Eigen::Vector3d centre_W;
  Eigen::Vector3d half_x;
  Eigen::Vector3d half_y;
  Eigen::Vector3d half_z;
};

Cuboid CuboidOf(const Box& box);

/// Adds the closed surface of a cuboid, cut across its y axis into `slices` so that light can vary
/// along it.
void AddCuboid(const Cuboid& cuboid, int slices, Mesh& mesh);

/// Adds the closed surface of a round bar along a path of at least two different points: a prism
/// with `sides` facets, with normals of the round bar. The path must nowhere run along z.
void AddBar(const std::vector<Eigen::Vector3d>& path_W, double radius_m, int sides, Mesh& mesh);

}  // namespace fenestra
