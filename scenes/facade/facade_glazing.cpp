#include "scenes/facade/facade_glazing.h"

namespace fenestra {
namespace {

constexpr double kRebate_m = 0.005;

void AddPane(const Box& hole, double z, Mesh& mesh) {
  const auto base = static_cast<uint32_t>(mesh.positions_W.size());
  const auto left = static_cast<float>(hole.low.x() - kRebate_m);
  const auto right = static_cast<float>(hole.high.x() + kRebate_m);
  const auto bottom = static_cast<float>(hole.low.y() - kRebate_m);
  const auto top = static_cast<float>(hole.high.y() + kRebate_m);
  const auto depth = static_cast<float>(z);
  mesh.positions_W.insert(
      mesh.positions_W.end(),
      {{left, bottom, depth}, {right, bottom, depth}, {right, top, depth}, {left, top, depth}});
  mesh.triangles.emplace_back(base, base + 1, base + 2);
  mesh.triangles.emplace_back(base, base + 2, base + 3);
}

}  // namespace

void AddPanes(const WindowOptions& options, const WindowPlan& window, Mesh& mesh) {
  const double middle_z = -options.setback_m - 0.5 * options.frame_depth_m;
  if (options.double_glazing) {
    AddPane(window.frame_hole, middle_z + 0.5 * kPaneGap_m, mesh);
    AddPane(window.frame_hole, middle_z - 0.5 * kPaneGap_m, mesh);
  } else {
    AddPane(window.frame_hole, middle_z, mesh);
  }
}

}  // namespace fenestra
