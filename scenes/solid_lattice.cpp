#include "scenes/solid_lattice.h"

#include <algorithm>
#include <map>

#include "core/check.h"

namespace fenestra {
namespace {

// Fixed coordinates closer than this are one: a micrometre, far above the rounding of sums of
// sizes.
constexpr double kSameCoordinate_m = 1e-6;

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

// Collects quads of one mesh, sharing the corners of faces that lie in one plane and look one way.
class MeshBuilder {
 public:
  explicit MeshBuilder(const std::array<std::vector<float>, 3>& breaks_m) : breaks_m_(breaks_m) {}

  // The face of a lattice cell at its low corner, perpendicular to `axis`.
  void AddFace(const std::array<int, 3>& low_corner, int axis, bool faces_up) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::array<uint32_t, 4> corner{};
    for (int i = 0; i < 4; ++i) {
      std::array<int, 3> at = low_corner;
      at[static_cast<size_t>(u)] += (i == 1 || i == 2) ? 1 : 0;
      at[static_cast<size_t>(v)] += (i >= 2) ? 1 : 0;
      corner[static_cast<size_t>(i)] = Vertex(at, 2 * axis + (faces_up ? 1 : 0));
    }
    if (!faces_up) std::swap(corner[1], corner[3]);
    mesh_.triangles.emplace_back(corner[0], corner[1], corner[2]);
    mesh_.triangles.emplace_back(corner[0], corner[2], corner[3]);
  }

  Mesh Take() { return std::move(mesh_); }

 private:
  uint32_t Vertex(const std::array<int, 3>& at, int facing) {
    const auto [entry, is_new] =
        index_.try_emplace({facing, at}, static_cast<uint32_t>(mesh_.positions_W.size()));
    if (is_new) {
      mesh_.positions_W.emplace_back(breaks_m_[0][static_cast<size_t>(at[0])],
                                     breaks_m_[1][static_cast<size_t>(at[1])],
                                     breaks_m_[2][static_cast<size_t>(at[2])]);
    }
    return entry->second;
  }

  const std::array<std::vector<float>, 3>& breaks_m_;
  std::map<std::pair<int, std::array<int, 3>>, uint32_t> index_;
  Mesh mesh_;
};

}  // namespace

std::vector<float> GradedBreaks(std::vector<double> fixed,
                                const std::function<double(double)>& cell_size) {
  std::ranges::sort(fixed);
  const auto same = [](double a, double b) { return b - a < kSameCoordinate_m; };
  fixed.erase(std::unique(fixed.begin(), fixed.end(), same), fixed.end());
  FENESTRA_CHECK(fixed.size() >= 2, "a lattice needs an extent");
  std::vector<float> breaks = {static_cast<float>(fixed.front())};
  for (size_t i = 1; i < fixed.size(); ++i) AppendHalves(fixed[i - 1], fixed[i], cell_size, breaks);
  return breaks;
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

SolidLattice::Solid SolidLattice::At(const Cell& cell) const {
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

Mesh SolidLattice::Surface(Solid solid, Faces faces, const std::string& name,
                           uint32_t material) const {
  MeshBuilder builder(breaks_m_);
  const auto add_faces_of = [&](const Cell& cell) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool up : {false, true}) {
        Cell neighbour = cell;
        neighbour[static_cast<size_t>(axis)] += up ? 1 : -1;
        if (!IsFace(neighbour, axis, up, faces)) continue;
        Cell low_corner = cell;
        if (up) low_corner[static_cast<size_t>(axis)] += 1;
        builder.AddFace(low_corner, axis, up);
      }
    }
  };
  for (int z = 0; z < CellCount(2); ++z) {
    for (int y = 0; y < CellCount(1); ++y) {
      for (int x = 0; x < CellCount(0); ++x) {
        if (At({x, y, z}) == solid) add_faces_of({x, y, z});
      }
    }
  }
  Mesh mesh = builder.Take();
  mesh.name = name;
  mesh.material = material;
  mesh.closed = true;
  return mesh;
}

}  // namespace fenestra
