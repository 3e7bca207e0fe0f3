#include "scenes/gltf/reader/skinning.h"

#include <fmt/format.h>

#include "core/io/input_error.h"
#include "scenes/gltf/reader/accessors.h"

namespace fenestra::gltf {
namespace {

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
