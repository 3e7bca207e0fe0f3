#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "renderers/light/light_patches.h"

namespace fenestra {

/// A place in a patch: s and t in units of 1 / kGridUnits.
struct GridNode {
  int32_t s = 0;
  int32_t t = 0;

  friend bool operator==(const GridNode&, const GridNode&) = default;
};

inline constexpr int32_t kGridUnits = 1 << 14;

glm::vec2 InPatch(const GridNode& node);

/// A patch's rectangle, cut into triangles on which light is interpolated. It begins as rectangles
/// of two triangles each; triangles are then halved where light needs it, each time at the middle
/// of the hypotenuse (in s and t). The triangle on the other side of that is halved too, so that
/// interpolated light has no steps.
///
/// Source: W. Evans, D. Kirkpatrick and G. Townsend, "Right-triangulated irregular networks",
/// Algorithmica 30 (2001).
class LightGrid {
 public:
  struct Cell {
    std::array<GridNode, 3> corners;  ///< The hypotenuse leads from the first to the second.
    int32_t first_child = -1;         ///< The other child is the next cell.
    bool is_used = true;              ///< Whether any of the patch's triangles overlaps it.

    GridNode Middle() const {
      return {(corners[0].s + corners[1].s) / 2, (corners[0].t + corners[1].t) / 2};
    }
    bool is_leaf() const { return first_child < 0; }
    /// The middle of a hypotenuse of less than two units is no node.
    bool can_be_halved() const;
  };

  /// 2^s_halvings x 2^t_halvings rectangles.
  LightGrid(const LightPatches& patches, uint32_t patch, int s_halvings, int t_halvings);

  const std::vector<Cell>& cells() const { return cells_; }
  std::vector<size_t> UsedLeaves() const;

  /// Halves a leaf, and before it what must be for that.
  void Halve(size_t leaf);

  /// The leaf that contains a point of the rectangle.
  size_t Find(const glm::vec2& st) const;

  int s_halvings() const { return s_halvings_; }
  int t_halvings() const { return t_halvings_; }

 private:
  std::vector<uint32_t> Overlapping(const Cell& cell, const std::vector<uint32_t>& among) const;
  void AddChild(size_t parent, const std::array<GridNode, 3>& corners);
  void HalveAlone(size_t leaf);

  const LightPatches* patches_;
  int s_halvings_;
  int t_halvings_;
  std::vector<Cell> cells_;
  std::vector<std::vector<uint32_t>> triangles_;  // Those of the patch that overlap a leaf.
};

/// The leaves of all faces in one table, for looking up what light leaves a hit.
class LightLeaves {
 public:
  struct Leaf {
    uint32_t face = 0;
    std::array<glm::vec2, 3> corners;
    std::array<uint32_t, 3> points{};  ///< Of a LightBake.

    /// The coefficients (c, c_s, c_t) of the function c + c_s s + c_t t that has these values at
    /// the corners.
    std::array<float, 3> Interpolate(const std::array<float, 3>& values) const;
  };

  /// Nothing is known of the faces that are not added.
  explicit LightLeaves(size_t face_count) : faces_(face_count) {}

  /// The leaves of a grid in the order of its UsedLeaves().
  void Add(uint32_t face, const LightGrid& grid, const std::vector<Leaf>& leaves);
  /// A face of one leaf.
  void Add(uint32_t face, const Leaf& leaf);

  static constexpr uint32_t kNone = ~0u;
  /// kNone for a face of which nothing is known.
  uint32_t Find(uint32_t face, const glm::vec2& st) const;
  /// Whether the leaf contains the point, or it is beside the leaf by no more than rounding.
  bool IsIn(uint32_t leaf, const glm::vec2& st) const;

  const std::vector<Leaf>& leaves() const { return leaves_; }

 private:
  struct Face {
    int32_t first_cell = -1;  // Or -2 - leaf, or -1 for none.
    int s_halvings = 0;
    int t_halvings = 0;
  };
  struct Edges {
    glm::vec2 origin{0.0f};
    glm::vec2 to_first{0.0f};  // Barycentric coordinates are its products with p - origin.
    glm::vec2 to_second{0.0f};
  };
  void AddLeaf(const Leaf& leaf);

  std::vector<Face> faces_;
  std::vector<int32_t> next_;  // Of each cell: its first child, or -1 - leaf.
  std::vector<Leaf> leaves_;
  std::vector<Edges> edges_;
};

}  // namespace fenestra
