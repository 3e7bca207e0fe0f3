#include "renderers/light/light_grid.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>
#include <utility>

namespace fenestra {
namespace {

using glm::vec2;

// Of a leaf's own size; two leaves agree along their common edge.
constexpr float kBeside = 1e-4f;

// The root cell that contains a point: two for each rectangle, the one below its diagonal first.
struct Place {
  size_t root;
  std::array<float, 3> weights;  // Barycentric, of the root's corners.
};

Place PlaceOf(const vec2& st, int s_halvings, int t_halvings) {
  const auto scaled = [](float value, int halvings, float& rest) {
    const int count = 1 << halvings;
    const float at = std::clamp(value, 0.0f, 1.0f) * static_cast<float>(count);
    const int index = std::min(static_cast<int>(at), count - 1);
    rest = at - static_cast<float>(index);
    return static_cast<size_t>(index);
  };
  float x = 0.0f;
  float y = 0.0f;
  const size_t column = scaled(st.x, s_halvings, x);
  const size_t row = scaled(st.y, t_halvings, y);
  const size_t rectangle = (row << s_halvings) + column;
  if (x >= y) return {2 * rectangle, {1.0f - x, y, x - y}};
  return {2 * rectangle + 1, {x, 1.0f - y, y - x}};
}

// Goes on to the child that contains the point; true for the second.
bool Descend(std::array<float, 3>& w) {
  if (w[0] >= w[1]) {
    w = {w[2], w[0] - w[1], 2.0f * w[1]};
    return false;
  }
  w = {w[1] - w[0], w[2], 2.0f * w[0]};
  return true;
}

}  // namespace

vec2 InPatch(const GridNode& node) {
  return {static_cast<float>(node.s) / static_cast<float>(kGridUnits),
          static_cast<float>(node.t) / static_cast<float>(kGridUnits)};
}

bool LightGrid::Cell::can_be_halved() const {
  return (corners[0].s + corners[1].s) % 2 == 0 && (corners[0].t + corners[1].t) % 2 == 0;
}

LightGrid::LightGrid(const LightPatches& patches, uint32_t patch, int s_halvings, int t_halvings)
    : patches_(&patches), s_halvings_(s_halvings), t_halvings_(t_halvings) {
  const std::vector<uint32_t>& all = patches.patches()[patch].triangles;
  const int32_t width = kGridUnits >> s_halvings;
  const int32_t height = kGridUnits >> t_halvings;
  for (int32_t row = 0; row < 1 << t_halvings; ++row) {
    for (int32_t column = 0; column < 1 << s_halvings; ++column) {
      const GridNode low{column * width, row * height};
      const GridNode high{low.s + width, low.t + height};
      for (const Cell& cell : {Cell{.corners = {low, high, {high.s, low.t}}},
                               Cell{.corners = {high, low, {low.s, high.t}}}}) {
        triangles_.push_back(Overlapping(cell, all));
        cells_.push_back(cell);
        cells_.back().is_used = !triangles_.back().empty();
      }
    }
  }
}

std::vector<uint32_t> LightGrid::Overlapping(const Cell& cell,
                                             const std::vector<uint32_t>& among) const {
  const PatchTriangle own = {InPatch(cell.corners[0]), InPatch(cell.corners[1]),
                             InPatch(cell.corners[2])};
  std::vector<uint32_t> found;
  for (const uint32_t t : among) {
    if (Overlap(own, patches_->InPatch(t))) found.push_back(t);
  }
  return found;
}

std::vector<size_t> LightGrid::UsedLeaves() const {
  std::vector<size_t> leaves;
  for (size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].is_leaf() && cells_[i].is_used) leaves.push_back(i);
  }
  return leaves;
}

void LightGrid::AddChild(size_t parent, const std::array<GridNode, 3>& corners) {
  const Cell cell{.corners = corners};
  triangles_.push_back(Overlapping(cell, triangles_[parent]));
  cells_.push_back(cell);
  cells_.back().is_used = !triangles_.back().empty();
}

void LightGrid::HalveAlone(size_t leaf) {
  const std::array<GridNode, 3> c = cells_[leaf].corners;
  const GridNode middle = cells_[leaf].Middle();
  cells_[leaf].first_child = static_cast<int32_t>(cells_.size());
  AddChild(leaf, {c[2], c[0], middle});
  AddChild(leaf, {c[1], c[2], middle});
  triangles_[leaf] = {};
}

void LightGrid::Halve(size_t leaf) {
  const std::array<GridNode, 3> c = cells_[leaf].corners;
  // The apex of the triangle beyond the hypotenuse.
  const GridNode beyond{c[0].s + c[1].s - c[2].s, c[0].t + c[1].t - c[2].t};
  const auto in_rectangle = [](int32_t x) { return x >= 0 && x <= kGridUnits; };
  if (in_rectangle(beyond.s) && in_rectangle(beyond.t)) {
    constexpr float kLittle = 1.0f / 8.0f;
    const vec2 probe = glm::mix(InPatch(cells_[leaf].Middle()), InPatch(beyond), kLittle);
    while (true) {
      const size_t other = Find(probe);
      if (!cells_[other].is_used) break;
      const std::array<GridNode, 3>& o = cells_[other].corners;
      if (o[0] == c[1] && o[1] == c[0]) {
        HalveAlone(other);
        break;
      }
      Halve(other);
    }
  }
  HalveAlone(leaf);
}

size_t LightGrid::Find(const vec2& st) const {
  Place place = PlaceOf(st, s_halvings_, t_halvings_);
  size_t cell = place.root;
  while (!cells_[cell].is_leaf()) {
    cell = static_cast<size_t>(cells_[cell].first_child) + (Descend(place.weights) ? 1 : 0);
  }
  return cell;
}

std::array<float, 3> LightLeaves::Leaf::Interpolate(const std::array<float, 3>& values) const {
  const vec2 a = corners[1] - corners[0];
  const vec2 b = corners[2] - corners[0];
  const float inverse = 1.0f / (a.x * b.y - a.y * b.x);
  const float da = values[1] - values[0];
  const float db = values[2] - values[0];
  const float per_s = (da * b.y - db * a.y) * inverse;
  const float per_t = (db * a.x - da * b.x) * inverse;
  return {values[0] - per_s * corners[0].x - per_t * corners[0].y, per_s, per_t};
}

void LightLeaves::AddLeaf(const Leaf& leaf) {
  const std::array<float, 3> first = leaf.Interpolate({0.0f, 1.0f, 0.0f});
  const std::array<float, 3> second = leaf.Interpolate({0.0f, 0.0f, 1.0f});
  leaves_.push_back(leaf);
  edges_.push_back({.origin = leaf.corners[0],
                    .to_first = {first[1], first[2]},
                    .to_second = {second[1], second[2]}});
}

void LightLeaves::Add(uint32_t face, const LightGrid& grid, const std::vector<Leaf>& leaves) {
  faces_[face] = {.first_cell = static_cast<int32_t>(next_.size()),
                  .s_halvings = grid.s_halvings(),
                  .t_halvings = grid.t_halvings()};
  const auto base = static_cast<int32_t>(next_.size());
  auto leaf = static_cast<int32_t>(leaves_.size());
  for (const Leaf& added : leaves) AddLeaf(added);
  // A ray that meets the surface beside all of its triangles by rounding finds the nearest leaf:
  // unused ones are of the used one before them.
  const int32_t first_leaf = leaf;
  for (const LightGrid::Cell& cell : grid.cells()) {
    if (!cell.is_leaf()) {
      next_.push_back(base + cell.first_child);
    } else if (cell.is_used) {
      next_.push_back(-1 - leaf++);
    } else {
      next_.push_back(-1 - std::max(leaf - 1, first_leaf));
    }
  }
}

void LightLeaves::Add(uint32_t face, const Leaf& leaf) {
  faces_[face].first_cell = -2 - static_cast<int32_t>(leaves_.size());
  leaves_.push_back(leaf);
  edges_.emplace_back();  // Contains all.
}

uint32_t LightLeaves::Find(uint32_t face, const vec2& st) const {
  const Face& f = faces_[face];
  if (f.first_cell < 0)
    return f.first_cell == -1 ? kNone : static_cast<uint32_t>(-2 - f.first_cell);
  Place place = PlaceOf(st, f.s_halvings, f.t_halvings);
  int32_t next = next_[static_cast<size_t>(f.first_cell) + place.root];
  while (next >= 0) next = next_[static_cast<size_t>(next) + (Descend(place.weights) ? 1 : 0)];
  return static_cast<uint32_t>(-1 - next);
}

bool LightLeaves::IsIn(uint32_t leaf, const vec2& st) const {
  const Edges& e = edges_[leaf];
  const vec2 p = st - e.origin;
  const float first = p.x * e.to_first.x + p.y * e.to_first.y;
  const float second = p.x * e.to_second.x + p.y * e.to_second.y;
  return first >= -kBeside && second >= -kBeside && first + second <= 1.0f + kBeside;
}

}  // namespace fenestra
