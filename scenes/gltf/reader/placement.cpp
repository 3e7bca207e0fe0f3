#include "scenes/gltf/reader/placement.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/io/input_error.h"
#include "scenes/gltf/reader/accessors.h"
#include "scenes/gltf/tinygltf.h"
#include "scenes/gltf/validation/extensions.h"

namespace fenestra::gltf {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

Matrix4d LocalTransform(const tinygltf::Node& node) {
  if (!node.matrix.empty()) return Eigen::Map<const Matrix4d>(node.matrix.data());
  Matrix4d M = Matrix4d::Identity();
  if (!node.rotation.empty()) {
    const Eigen::Quaterniond q(node.rotation[3], node.rotation[0], node.rotation[1],
                               node.rotation[2]);
    M.topLeftCorner<3, 3>() = q.normalized().toRotationMatrix();
  }
  for (int i = 0; i < 3 && !node.scale.empty(); ++i) {
    M.col(i) *= node.scale[static_cast<size_t>(i)];
  }
  for (int i = 0; i < 3 && !node.translation.empty(); ++i) {
    M(i, 3) = node.translation[static_cast<size_t>(i)];
  }
  return M;
}

std::vector<int> RootsOf(const Asset& asset, std::optional<int> scene_index) {
  const auto& scenes = asset.model.scenes;
  if (scene_index) {
    if (*scene_index < 0 || static_cast<size_t>(*scene_index) >= scenes.size()) {
      throw InputError(asset.file, fmt::format("scene {} does not exist; there {} {}", *scene_index,
                                               scenes.size() == 1 ? "is" : "are", scenes.size()));
    }
    return scenes[static_cast<size_t>(*scene_index)].nodes;
  }
  if (!scenes.empty()) {
    return scenes[static_cast<size_t>(std::max(0, asset.model.defaultScene))].nodes;
  }
  // A library of nodes without a scene: show all of them.
  std::vector<bool> is_child(asset.model.nodes.size(), false);
  for (const tinygltf::Node& node : asset.model.nodes) {
    for (const int child : node.children) is_child[static_cast<size_t>(child)] = true;
  }
  std::vector<int> roots;
  for (size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

constexpr size_t kNoParent = static_cast<size_t>(-1);

struct Waiting {
  size_t node;
  size_t parent;  // In the list of placed nodes.
};

PlacedNode Place(const Asset& asset, const Waiting& next, const std::vector<PlacedNode>& placed) {
  const tinygltf::Node& source = asset.model.nodes[next.node];
  PlacedNode node{.node = next.node};
  node.M_WN = LocalTransform(source);
  if (const tinygltf::Value* visibility = Extension(source.extensions, "KHR_node_visibility")) {
    const tinygltf::Value* visible = Find(*visibility, {"visible"});
    node.is_visible = visible == nullptr || visible->Get<bool>();
  }
  if (next.parent != kNoParent) {
    const PlacedNode& parent = placed[next.parent];
    node.M_WN = parent.M_WN * node.M_WN;
    node.is_visible = node.is_visible && parent.is_visible;
  }
  if (!node.M_WN.allFinite()) {
    throw InputError(asset.file,
                     fmt::format("/nodes/{}: its place in the world is not finite", next.node));
  }
  return node;
}

using Eigen::Matrix4d;

std::vector<float> ReadAttribute(const Asset& asset, const tinygltf::Value& attributes,
                                 const char* name) {
  const tinygltf::Value* index = Find(attributes, {name});
  return index == nullptr ? std::vector<float>() : ReadFloats(asset, index->GetNumberAsInt());
}

using Eigen::Matrix4d;

// M_WJ B of each joint.
std::vector<Matrix4d> JointTransforms(const Asset& asset, size_t skin_index,
                                      const std::vector<const PlacedNode*>& by_node) {
  const tinygltf::Skin& skin = asset.model.skins[skin_index];
  std::vector<float> bind;
  if (skin.inverseBindMatrices >= 0) bind = ReadFloats(asset, skin.inverseBindMatrices);
  std::vector<Matrix4d> transforms;
  for (size_t i = 0; i < skin.joints.size(); ++i) {
    const auto joint = static_cast<size_t>(skin.joints[i]);
    const PlacedNode* placed = by_node[joint];
    if (placed == nullptr) {
      throw InputError(asset.file, fmt::format("/skins/{}/joints/{}: /nodes/{} is not in the scene",
                                               skin_index, i, joint));
    }
    Matrix4d M = placed->M_WN;
    if (!bind.empty()) {
      const Matrix4d B = Eigen::Map<const Eigen::Matrix4f>(&bind[16 * i]).cast<double>();
      if (B.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
        throw InputError(asset.file,
                         fmt::format("/accessors/{}: the last row of matrix {} must be 0, 0, 0, 1",
                                     skin.inverseBindMatrices, i));
      }
      M = M * B;
    }
    transforms.push_back(M);
  }
  return transforms;
}

}  // namespace

std::vector<PlacedNode> PlaceNodes(const Asset& asset, std::optional<int> scene_index) {
  std::vector<PlacedNode> placed;
  std::vector<size_t> parents;
  // Not recursive: a chain of nodes may be a million long.
  std::vector<Waiting> stack;
  const auto push_reversed = [&stack](const std::vector<int>& nodes, size_t parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
      stack.push_back({static_cast<size_t>(*node), parent});
    }
  };
  push_reversed(RootsOf(asset, scene_index), kNoParent);
  while (!stack.empty()) {
    const Waiting next = stack.back();
    stack.pop_back();
    placed.push_back(Place(asset, next, placed));
    parents.push_back(next.parent);
    placed.back().subtree_end = placed.size();
    push_reversed(asset.model.nodes[next.node].children, placed.size() - 1);
  }
  for (size_t i = placed.size(); i-- > 0;) {
    if (parents[i] == kNoParent) continue;
    PlacedNode& parent = placed[parents[i]];
    parent.subtree_end = std::max(parent.subtree_end, placed[i].subtree_end);
  }
  return placed;
}

std::optional<ScaledPose> RigidPart(const Matrix4d& M_WN) {
  // Numbers of single precision, through a few products, are off by less.
  constexpr double kShearTolerance = 1e-5;
  constexpr double kExactTolerance = 1e-12;
  const Matrix3d L = M_WN.topLeftCorner<3, 3>();
  const Vector3d p_WN = M_WN.topRightCorner<3, 1>();
  const Vector3d scale = L.colwise().norm();
  if (!(scale.minCoeff() > 0.0) || !scale.allFinite()) return std::nullopt;
  const Matrix3d R = L * scale.cwiseInverse().asDiagonal();
  const double deviation = (R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation < kShearTolerance) || !(R.determinant() > 0.0)) return std::nullopt;
  const double distance = (L.transpose() * L - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (distance < kExactTolerance) return ScaledPose{Pose(L, p_WN), Vector3d::Ones()};
  // The nearest rotation.
  const Eigen::JacobiSVD<Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return ScaledPose{Pose(svd.matrixU() * svd.matrixV().transpose(), p_WN), scale};
}

std::vector<Matrix4d> InstanceTransforms(const Asset& asset, const tinygltf::Node& node) {
  const tinygltf::Value* attributes = InstanceAttributes(node);
  if (attributes == nullptr) return {Matrix4d::Identity()};
  const std::vector<float> translations = ReadAttribute(asset, *attributes, "TRANSLATION");
  const std::vector<float> rotations = ReadAttribute(asset, *attributes, "ROTATION");
  const std::vector<float> scales = ReadAttribute(asset, *attributes, "SCALE");
  std::vector<Matrix4d> transforms(InstanceCount(asset.model, node), Matrix4d::Identity());
  for (size_t i = 0; i < transforms.size(); ++i) {
    Eigen::Affine3d X = Eigen::Affine3d::Identity();
    if (!translations.empty()) {
      X.translate(Eigen::Map<const Eigen::Vector3f>(&translations[3 * i]).cast<double>());
    }
    if (!rotations.empty()) {
      const Eigen::Quaterniond q =
          Eigen::Map<const Eigen::Quaternionf>(&rotations[4 * i]).cast<double>();
      if (!(q.norm() > 0.0)) {
        throw InputError(asset.file, fmt::format("node '{}': the rotation of instance {} is zero",
                                                 node.name, i));
      }
      X.rotate(q.normalized());
    }
    if (!scales.empty()) {
      X.scale(Eigen::Map<const Eigen::Vector3f>(&scales[3 * i]).cast<double>());
    }
    transforms[i] = X.matrix();
  }
  return transforms;
}

std::vector<Matrix4d> SkinTransforms(const Asset& asset, size_t skin, const Surface& surface,
                                     const std::vector<const PlacedNode*>& by_node) {
  const std::vector<Matrix4d> joints = JointTransforms(asset, skin, by_node);
  std::vector<Matrix4d> transforms(surface.positions_M.size(), Matrix4d::Zero());
  for (size_t v = 0; v < transforms.size(); ++v) {
    double sum = 0.0;
    for (const JointWeights& set : surface.joint_sets) {
      for (int k = 0; k < 4; ++k) {
        const double weight = set.weights[v][k];
        if (weight == 0.0) continue;
        const auto joint = static_cast<size_t>(set.joints[v][k]);
        if (joint >= joints.size()) {
          throw InputError(asset.file,
                           fmt::format("/skins/{}: vertex {} is moved by joint {}; there "
                                       "are {}",
                                       skin, v, joint, joints.size()));
        }
        transforms[v] += weight * joints[joint];
        sum += weight;
      }
    }
    if (sum > 0.0) {
      transforms[v] /= sum;
    } else {
      transforms[v] = joints.front();  // Nothing moves it; it has to stand somewhere.
    }
  }
  return transforms;
}

}  // namespace fenestra::gltf
