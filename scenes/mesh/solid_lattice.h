#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace fenestra {

/// An axis-aligned box in W [m].
struct Box {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

/// One of several solids of which a building is made; 0 is air.
using Solid = uint8_t;
inline constexpr Solid kAir = 0;

/// The surface between solids and air. Positions are shared by all triangles that meet in them,
/// whatever their solids, so that a change to an edge reaches all its triangles.
struct SolidSurface {
  struct Triangle {
    glm::uvec3 corners;  ///< Counter-clockwise as seen from the air.
    Solid solid;
    uint8_t facing;  ///< 0 to 5: -x, +x, -y, +y, -z, +z.
  };
  std::vector<glm::vec3> positions_W;
  std::vector<Triangle> triangles;
};

/// The triangles of one solid. Vertices are shared only between faces of one direction.
Mesh MeshOf(const SolidSurface& surface, Solid solid, const std::string& name, uint32_t material);

/// Sorted coordinates without near duplicates: two of them less than a micrometre apart are one.
std::vector<float> DistinctBreaks(std::vector<double> coordinates_m);

/// Distinct breaks, with each gap halved until its cells are not longer than `cell_size` at their
/// middle.
std::vector<float> GradedBreaks(std::vector<double> fixed_m,
                                const std::function<double(double)>& cell_size);

/// Buildings from blocks: a rectilinear lattice whose cells are air or one of several solids.
/// Where a solid meets air there is a surface, tessellated by the lattice itself. So neighbouring
/// faces share the very same corners (no cracks, no T-junctions), and no two faces overlap. Outside
/// the lattice is air.
class SolidLattice {
 public:
  /// Break coordinates along x, y and z, ascending, at least two each.
  explicit SolidLattice(std::array<std::vector<float>, 3> breaks_m);

  /// Fills the cells whose centres are in the box, over what was there before.
  void Fill(const Box& box, Solid solid);

  enum class Faces {
    kAll,
    kFrontOfLattice,  ///< Without the faces on the lattice's own border, but for that at +z.
  };

  /// The faces between solids and air.
  SolidSurface Surface(Faces faces) const;

  /// The faces between one solid and air.
  Mesh Surface(Solid solid, Faces faces, const std::string& name, uint32_t material) const {
    return MeshOf(Surface(faces), solid, name, material);
  }

 private:
  using Cell = std::array<int, 3>;

  int CellCount(int axis) const;
  Solid At(const Cell& cell) const;
  size_t IndexOf(const Cell& cell) const;
  bool IsFace(const Cell& air, int axis, bool up, Faces faces) const;

  std::array<std::vector<float>, 3> breaks_m_;
  std::vector<Solid> cells_;
};

}  // namespace fenestra
