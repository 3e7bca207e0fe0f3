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

/// Sorted coordinates from the first to the last of `fixed`, which are all kept; each gap is halved
/// until its cells are not longer than `cell_size` at their middle. Metres.
std::vector<float> GradedBreaks(std::vector<double> fixed,
                                const std::function<double(double)>& cell_size);

/// Buildings from blocks: a rectilinear lattice whose cells are air or one of several solids.
/// Where a solid meets air there is a surface, tessellated by the lattice itself. So neighbouring
/// faces share the very same corners (no cracks, no T-junctions), and no two faces overlap. Outside
/// the lattice is air.
class SolidLattice {
 public:
  using Solid = uint8_t;
  static constexpr Solid kAir = 0;

  /// Break coordinates along x, y and z, ascending, at least two each.
  explicit SolidLattice(std::array<std::vector<float>, 3> breaks_m);

  /// Fills the cells whose centres are in the box, over what was there before.
  void Fill(const Box& box, Solid solid);

  enum class Faces {
    kAll,
    kFrontOfLattice,  ///< Without the faces on the lattice's own border, but for that at +z.
  };

  /// The faces between `solid` and air. Triangles wind counter-clockwise as seen from the air;
  /// vertices are shared only between faces of one plane.
  Mesh Surface(Solid solid, Faces faces, const std::string& name, uint32_t material) const;

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
