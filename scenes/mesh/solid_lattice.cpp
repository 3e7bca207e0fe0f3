#include "scenes/mesh/solid_lattice.h"

#include <algorithm>
#include <limits>

#include "core/system/check.h"

namespace fenestra {
namespace {

// Coordinates closer than this are one: a micrometre, far above the rounding of sums of sizes.
constexpr double kSameCoordinate_m = 1e-6;
constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

void AppendHalves(double low, double high, const std::function<double(double)>& cell_size,
                  std::vector<float>& breaks) {
  const double middle = 0.5 * (low + high);
  if (high - low > cell_size(middle)) {
    AppendHalves(low, middle, cell_size, breaks);
    AppendHalves(middle, high, cell_size, breaks);
  } else {
    breaks.push_back(static_cast<float>(high));
  }
}

std::vector<double> Distinct(std::vector<double> coordinates_m) {
  std::ranges::sort(coordinates_m);
  const auto same = [](double a, double b) { return b - a < kSameCoordinate_m; };
  coordinates_m.erase(std::unique(coordinates_m.begin(), coordinates_m.end(), same),
                      coordinates_m.end());
  FENESTRA_CHECK(coordinates_m.size() >= 2, "a lattice needs an extent");
  return coordinates_m;
}

// Collects faces of lattice cells; corners of the lattice become positions when first used.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const std::array<std::vector<float>, 3>& breaks_m)
      : breaks_m_(breaks_m),
        position_of_(breaks_m[0].size() * breaks_m[1].size() * breaks_m[2].size(), kNone) {}

  // The face of a lattice cell at its low corner, perpendicular to `axis`.
  void AddFace(const std::array<int, 3>& low_corner, int axis, bool faces_up, Solid solid) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::array<uint32_t, 4> corner{};
    for (int i = 0; i < 4; ++i) {
      std::array<int, 3> at = low_corner;
      at[static_cast<size_t>(u)] += (i == 1 || i == 2) ? 1 : 0;
      at[static_cast<size_t>(v)] += (i >= 2) ? 1 : 0;
      corner[static_cast<size_t>(i)] = Position(at);
    }
    if (!faces_up) std::swap(corner[1], corner[3]);
    const auto facing = static_cast<uint8_t>(2 * axis + (faces_up ? 1 : 0));
    surface_.triangles.push_back({{corner[0], corner[1], corner[2]}, solid, facing});
    surface_.triangles.push_back({{corner[0], corner[2], corner[3]}, solid, facing});
  }

  SolidSurface Take() { return std::move(surface_); }

 private:
  uint32_t Position(const std::array<int, 3>& at) {
    const auto x = static_cast<size_t>(at[0]);
    const auto y = static_cast<size_t>(at[1]);
    const auto z = static_cast<size_t>(at[2]);
    uint32_t& index = position_of_[(z * breaks_m_[1].size() + y) * breaks_m_[0].size() + x];
    if (index == kNone) {
      index = static_cast<uint32_t>(surface_.positions_W.size());
      surface_.positions_W.emplace_back(breaks_m_[0][x], breaks_m_[1][y], breaks_m_[2][z]);
    }
    return index;
  }

  const std::array<std::vector<float>, 3>& breaks_m_;
  std::vector<uint32_t> position_of_;
  SolidSurface surface_;
};

}  // namespace

std::vector<float> DistinctBreaks(std::vector<double> coordinates_m) {
  const std::vector<double> distinct_m = Distinct(std::move(coordinates_m));
  return {distinct_m.begin(), distinct_m.end()};
}

std::vector<float> GradedBreaks(std::vector<double> fixed_m,
                                const std::function<double(double)>& cell_size) {
  const std::vector<double> fixed = Distinct(std::move(fixed_m));
  std::vector<float> breaks = {static_cast<float>(fixed.front())};
  for (size_t i = 1; i < fixed.size(); ++i) AppendHalves(fixed[i - 1], fixed[i], cell_size, breaks);
  return breaks;
}

Mesh MeshOf(const SolidSurface& surface, Solid solid, const std::string& name, uint32_t material) {
  Mesh mesh{.name = name, .material = material, .closed = true};
  std::array<uint32_t, 6> unused{};
  unused.fill(kNone);
  std::vector<std::array<uint32_t, 6>> vertex_of(surface.positions_W.size(), unused);
  for (const SolidSurface::Triangle& triangle : surface.triangles) {
    if (triangle.solid != solid) continue;
    glm::uvec3 corners;
    for (int k = 0; k < 3; ++k) {
      const uint32_t position = triangle.corners[k];
      uint32_t& vertex = vertex_of[position][triangle.facing];
      if (vertex == kNone) {
        vertex = static_cast<uint32_t>(mesh.positions_W.size());
        mesh.positions_W.push_back(surface.positions_W[position]);
      }
      corners[k] = vertex;
    }
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

SolidLattice::SolidLattice(std::array<std::vector<float>, 3> breaks_m)
    : breaks_m_(std::move(breaks_m)) {
  size_t count = 1;
  for (const std::vector<float>& breaks : breaks_m_) {
    FENESTRA_CHECK(breaks.size() >= 2 && std::ranges::is_sorted(breaks, std::less_equal<>{}),
                   "breaks must ascend");
    count *= breaks.size() - 1;
  }
  cells_.assign(count, kAir);
}

int SolidLattice::CellCount(int axis) const {
  return static_cast<int>(breaks_m_[static_cast<size_t>(axis)].size()) - 1;
}

size_t SolidLattice::IndexOf(const Cell& cell) const {
  return (static_cast<size_t>(cell[2]) * static_cast<size_t>(CellCount(1)) +
          static_cast<size_t>(cell[1])) *
             static_cast<size_t>(CellCount(0)) +
         static_cast<size_t>(cell[0]);
}

Solid SolidLattice::At(const Cell& cell) const {
  for (int axis = 0; axis < 3; ++axis) {
    const int i = cell[static_cast<size_t>(axis)];
    if (i < 0 || i >= CellCount(axis)) return kAir;
  }
  return cells_[IndexOf(cell)];
}

void SolidLattice::Fill(const Box& box, Solid solid) {
  Cell first{};
  Cell last{};  // One past the end.
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float>& breaks = breaks_m_[static_cast<size_t>(axis)];
    const auto centre = [&breaks](int i) {
      const auto k = static_cast<size_t>(i);
      return 0.5 * (static_cast<double>(breaks[k]) + static_cast<double>(breaks[k + 1]));
    };
    int i = 0;
    while (i < CellCount(axis) && centre(i) < box.low[axis]) ++i;
    first[static_cast<size_t>(axis)] = i;
    while (i < CellCount(axis) && centre(i) < box.high[axis]) ++i;
    last[static_cast<size_t>(axis)] = i;
  }
  for (int z = first[2]; z < last[2]; ++z) {
    for (int y = first[1]; y < last[1]; ++y) {
      for (int x = first[0]; x < last[0]; ++x) cells_[IndexOf({x, y, z})] = solid;
    }
  }
}

bool SolidLattice::IsFace(const Cell& air, int axis, bool up, Faces faces) const {
  if (At(air) != kAir) return false;
  const int i = air[static_cast<size_t>(axis)];
  const bool on_border = i < 0 || i >= CellCount(axis);
  return faces == Faces::kAll || !on_border || (axis == 2 && up);
}

SolidSurface SolidLattice::Surface(Faces faces) const {
  SurfaceBuilder builder(breaks_m_);
  const auto add_faces_of = [&](const Cell& cell) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool up : {false, true}) {
        Cell neighbour = cell;
        neighbour[static_cast<size_t>(axis)] += up ? 1 : -1;
        if (!IsFace(neighbour, axis, up, faces)) continue;
        Cell low_corner = cell;
        if (up) low_corner[static_cast<size_t>(axis)] += 1;
        builder.AddFace(low_corner, axis, up, At(cell));
      }
    }
  };
  for (int z = 0; z < CellCount(2); ++z) {
    for (int y = 0; y < CellCount(1); ++y) {
      for (int x = 0; x < CellCount(0); ++x) {
        if (At({x, y, z}) != kAir) add_faces_of({x, y, z});
      }
    }
  }
  return builder.Take();
}

}  // namespace fenestra
