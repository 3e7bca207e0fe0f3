#include "scenes/gltf/reader/windows.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "core/io/faults.h"
#include "scenes/gltf/file/document.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

std::string PointerTo(const PlacedNode& placed) {
  return fmt::format("/nodes/{}", placed.node);
}

// The window whose frame O is the node's.
std::optional<TargetWindow> MarkedWindow(const PlacedNode& placed, const tinygltf::Value& size,
                                         Faults& faults) {
  const auto rigid = RigidPart(placed.M_WN);
  if (!rigid) {
    faults.Add(PointerTo(placed), "a window must not be sheared, mirrored or scaled to nothing");
    return std::nullopt;
  }
  return TargetWindow{.X_WO = rigid->X_WN,
                      .width_m = rigid->scale.x() * NumberOr(Find(size, {"width_m"}), 0.0),
                      .height_m = rigid->scale.y() * NumberOr(Find(size, {"height_m"}), 0.0)};
}

// The +z face of the bounding box, in the node's axes, of all that hangs on placed node i.
std::optional<TargetWindow> BoundingWindow(const std::vector<PlacedNode>& nodes, size_t i,
                                           const PlacedMeshes& meshes, Faults& faults) {
  const auto rigid = RigidPart(nodes[i].M_WN);
  if (!rigid) {
    faults.Add(PointerTo(nodes[i]), "a window must not be sheared, mirrored or scaled to nothing");
    return std::nullopt;
  }
  const Pose X_NW = rigid->X_WN.inverse();
  AlignedBox3d box;
  for (size_t m = meshes.first_mesh[i]; m < meshes.first_mesh[nodes[i].subtree_end]; ++m) {
    for (const glm::vec3& p : meshes.meshes[m].positions_W) {
      box.extend(X_NW * Vector3d(p.x, p.y, p.z));
    }
  }
  if (box.isEmpty() || !(box.sizes().x() > 0.0) || !(box.sizes().y() > 0.0)) {
    faults.Add(PointerTo(nodes[i]), "has no triangles that span a window's width and height");
    return std::nullopt;
  }
  const Vector3d p_NO(box.center().x(), box.center().y(), box.max().z());
  return TargetWindow{.X_WO = rigid->X_WN * Pose::Translation(p_NO),
                      .width_m = box.sizes().x(),
                      .height_m = box.sizes().y()};
}

// Index of the placed node with that name.
std::optional<size_t> FindNode(const Asset& asset, const std::vector<PlacedNode>& nodes,
                               const std::string& name, Faults& faults) {
  std::vector<size_t> found;
  std::vector<std::string> names;
  for (size_t i = 0; i < nodes.size(); ++i) {
    names.push_back(asset.model.nodes[nodes[i].node].name);
    if (names.back() == name) found.push_back(i);
  }
  if (found.size() == 1) return found[0];
  if (found.empty()) {
    faults.Add(
        "", fmt::format("no node of the scene is called '{}'.{}", name, DidYouMean(name, names)));
  } else {
    faults.Add("", fmt::format(
                       "{} nodes are called '{}', among them {} and {}; a target's name must "
                       "be its own",
                       found.size(), name, PointerTo(nodes[found[0]]), PointerTo(nodes[found[1]])));
  }
  return std::nullopt;
}

}  // namespace

Windows FindWindows(const Asset& asset, const std::vector<PlacedNode>& nodes,
                    const PlacedMeshes& meshes, const std::optional<std::string>& target_node) {
  Faults faults(asset.file.string(), kMostFaults);
  std::optional<size_t> named;
  if (target_node) named = FindNode(asset, nodes, *target_node, faults);
  Windows windows;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const tinygltf::Value& extras = asset.model.nodes[nodes[i].node].extras;
    const tinygltf::Value* target = Find(extras, {"fenestra", "target_window"});
    const tinygltf::Value* other = Find(extras, {"fenestra", "other_window"});
    const tinygltf::Value* size = target != nullptr ? target : other;
    const bool is_target = target_node ? named == i : target != nullptr;
    if (size == nullptr && !is_target) continue;
    const auto window = size != nullptr ? MarkedWindow(nodes[i], *size, faults)
                                        : BoundingWindow(nodes, i, meshes, faults);
    if (!window) continue;
    if (!is_target) {
      windows.others.push_back(*window);
    } else if (windows.target) {
      faults.Add(PointerTo(nodes[i]) + "/extras/fenestra/target_window",
                 "there is a target already; mark all but one as 'other_window'");
    } else {
      windows.target = *window;
    }
  }
  faults.ThrowIfAny();
  return windows;
}

}  // namespace fenestra::gltf
