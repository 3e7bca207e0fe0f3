#include <fmt/format.h>

#include <array>
#include <cmath>

#include "scenes/gltf/validation/structure_check.h"

namespace fenestra::gltf {
namespace {

constexpr int kNone = -1;

// Each node's parent. A node with two of them is a fault.
std::vector<int> Parents(const tinygltf::Model& model, Faults& faults) {
  std::vector<int> parents(model.nodes.size(), kNone);
  for (size_t i = 0; i < model.nodes.size(); ++i) {
    for (size_t k = 0; k < model.nodes[i].children.size(); ++k) {
      int& parent = parents[static_cast<size_t>(model.nodes[i].children[k])];
      if (parent != kNone) {
        faults.Add(fmt::format("/nodes/{}/children/{}", i, k),
                   fmt::format("/nodes/{} is a child of /nodes/{} already",
                               model.nodes[i].children[k], parent));
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

// With one parent each, nodes that no root reaches stand in loops.
void CheckForLoops(const tinygltf::Model& model, const std::vector<int>& parents, Faults& faults) {
  std::vector<bool> is_reached(model.nodes.size(), false);
  std::vector<size_t> waiting;
  for (size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] == kNone) waiting.push_back(i);
  }
  while (!waiting.empty()) {
    const size_t node = waiting.back();
    waiting.pop_back();
    if (is_reached[node]) continue;  // Where a fault gave it two parents.
    is_reached[node] = true;
    for (const int child : model.nodes[node].children) {
      waiting.push_back(static_cast<size_t>(child));
    }
  }
  for (size_t i = 0; i < is_reached.size(); ++i) {
    if (!is_reached[i]) faults.Add(fmt::format("/nodes/{}", i), "is its own ancestor");
  }
}

void CheckTransform(const nlohmann::json& node, const std::string& at, Faults& faults) {
  if (node.contains("matrix")) {
    for (const char* name : {"translation", "rotation", "scale"}) {
      if (node.contains(name)) faults.Add(at + "/" + name, "must not stand beside a matrix");
    }
    const auto m = node["matrix"].get<std::array<double, 16>>();
    if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0) {
      faults.Add(at + "/matrix", "its last row must be 0, 0, 0, 1");
    }
  }
  if (node.contains("rotation")) {
    const auto q = node["rotation"].get<std::array<double, 4>>();
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    // Written with few digits it is off by some 1e-3; farther off it was never meant as a rotation.
    if (!(std::abs(norm - 1.0) < 0.01)) {
      faults.Add(at + "/rotation", fmt::format("must be a unit quaternion; its norm is {}", norm));
    }
  }
}

void CheckNode(const tinygltf::Model& model, const tinygltf::Node& node, const std::string& at,
               Faults& faults) {
  if (node.mesh < 0) {
    if (node.skin >= 0) faults.Add(at + "/skin", "a skin needs a mesh");
    if (!node.weights.empty()) faults.Add(at + "/weights", "weights need a mesh");
    return;
  }
  const tinygltf::Primitive& primitive =
      model.meshes[static_cast<size_t>(node.mesh)].primitives.front();
  for (const auto& part : model.meshes[static_cast<size_t>(node.mesh)].primitives) {
    if (node.skin < 0 || part.attributes.contains("JOINTS_0")) continue;
    faults.Add(at + "/skin", fmt::format("/meshes/{} has no JOINTS_0 to be moved by", node.mesh));
    break;
  }
  if (!node.weights.empty() && node.weights.size() != primitive.targets.size()) {
    faults.Add(at + "/weights", fmt::format("{} weights for {} morph targets", node.weights.size(),
                                            primitive.targets.size()));
  }
}

void CheckScene(const tinygltf::Scene& scene, const std::vector<int>& parents,
                const std::string& at, Faults& faults) {
  for (size_t k = 0; k < scene.nodes.size(); ++k) {
    const int parent = parents[static_cast<size_t>(scene.nodes[k])];
    if (parent == kNone) continue;
    faults.Add(fmt::format("{}/nodes/{}", at, k),
               fmt::format("/nodes/{} is a child of /nodes/{}; scenes name roots", scene.nodes[k],
                           parent));
  }
}

}  // namespace

void CheckNodes(const tinygltf::Model& model, const nlohmann::json& root, Faults& faults) {
  const std::vector<int> parents = Parents(model, faults);
  CheckForLoops(model, parents, faults);
  for (size_t i = 0; i < model.nodes.size(); ++i) {
    const std::string at = fmt::format("/nodes/{}", i);
    CheckTransform(root["nodes"][i], at, faults);
    CheckNode(model, model.nodes[i], at, faults);
  }
  for (size_t i = 0; i < model.scenes.size(); ++i) {
    CheckScene(model.scenes[i], parents, fmt::format("/scenes/{}", i), faults);
  }
}

void CheckSkins(const tinygltf::Model& model, Faults& faults) {
  for (size_t i = 0; i < model.skins.size(); ++i) {
    const tinygltf::Skin& skin = model.skins[i];
    if (skin.inverseBindMatrices < 0) continue;
    const auto& accessor = model.accessors[static_cast<size_t>(skin.inverseBindMatrices)];
    const std::string at = fmt::format("/skins/{}/inverseBindMatrices", i);
    if (accessor.type != TINYGLTF_TYPE_MAT4 ||
        accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
      faults.Add(at, fmt::format("/accessors/{} must be 4x4 matrices of floats",
                                 skin.inverseBindMatrices));
    }
    if (accessor.count < skin.joints.size()) {
      faults.Add(at, fmt::format("{} matrices for {} joints", accessor.count, skin.joints.size()));
    }
  }
}

}  // namespace fenestra::gltf
