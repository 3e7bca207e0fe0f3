#include "scenes/gltf/reader/origin.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "scenes/gltf/reader/accessors.h"
#include "scenes/gltf/reader/surfaces.h"
#include "scenes/gltf/tinygltf.h"

namespace fenestra::gltf {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

constexpr double kFarthestMiddle_m = 100.0;
// Beyond it, neighbouring floats are a millimetre apart.
constexpr double kFarthestPart_m = 10e3;
constexpr double kCoarse_m = 1e-3;

// Distance of neighbouring floats.
double Spacing(double value) {
  return std::abs(value) * static_cast<double>(std::numeric_limits<float>::epsilon());
}

double Largest(const AlignedBox3d& box) {
  return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
}

// The box around the corners of a box that a transform carries away; exact for its middle.
AlignedBox3d Carried(const Matrix4d& M_FM, const AlignedBox3d& box_M) {
  AlignedBox3d box;
  for (int i = 0; i < 8; ++i) {
    const Vector3d p_M = box_M.corner(static_cast<AlignedBox3d::CornerType>(i));
    box.extend(M_FM.topLeftCorner<3, 3>() * p_M + M_FM.topRightCorner<3, 1>());
  }
  return box;
}

struct Body {
  AlignedBox3d box_F;
  double triangles;
  size_t placed;  // Index of its node.
};

// Where everything that has triangles stands. Morphed and skinned bodies are taken for unmoved ones
// at their node or their first joint: this only chooses a frame, in which anything is right.
class Survey {
 public:
  Survey(const Asset& asset, const std::vector<PlacedNode>& nodes, Notes& notes)
      : asset_(asset), notes_(notes) {
    std::map<int, const PlacedNode*> by_node;
    for (const PlacedNode& placed : nodes) by_node[static_cast<int>(placed.node)] = &placed;
    for (size_t i = 0; i < nodes.size(); ++i) {
      const tinygltf::Node& node = asset.model.nodes[nodes[i].node];
      if (node.mesh < 0 || !nodes[i].is_visible) continue;
      Matrix4d M_FN = nodes[i].M_WN;
      if (node.skin >= 0) {
        const int joint = asset.model.skins[static_cast<size_t>(node.skin)].joints.front();
        if (by_node.contains(joint)) M_FN = by_node[joint]->M_WN;
      }
      Add(node, M_FN, i);
    }
  }

  const std::vector<Body>& bodies() const { return bodies_; }
  std::string NameOf(const Body& body, const std::vector<PlacedNode>& nodes) const {
    const tinygltf::Node& node = asset_.model.nodes[nodes[body.placed].node];
    return Named("mesh", node.name, static_cast<size_t>(node.mesh));
  }

 private:
  void Add(const tinygltf::Node& node, const Matrix4d& M_FN, size_t placed) {
    const std::vector<Matrix4d> instances = InstanceTransforms(asset_, node);
    const auto mesh = static_cast<size_t>(node.mesh);
    const std::string thing = Named("mesh", node.name, mesh);
    for (const tinygltf::Primitive& primitive : asset_.model.meshes[mesh].primitives) {
      if (!IsSurface(primitive)) continue;
      const int positions = primitive.attributes.at("POSITION");
      const AlignedBox3d& box_M = BoxOf(positions);
      if (box_M.isEmpty()) continue;
      if (asset_.model.accessors[static_cast<size_t>(positions)].componentType ==
          TINYGLTF_COMPONENT_TYPE_FLOAT) {
        NoteCoarse(Largest(box_M), M_FN, thing);
      }
      const auto triangles = static_cast<double>(ClaimedTriangles(asset_, primitive));
      for (const Matrix4d& M_NI : instances) {
        NoteCoarse(M_NI.topRightCorner<3, 1>().cwiseAbs().maxCoeff(), M_FN, thing);
        bodies_.push_back({Carried(M_FN * M_NI, box_M), triangles, placed});
      }
    }
  }

  // What is stored as a float so far from its node that the next float is a millimetre away.
  void NoteCoarse(double largest, const Matrix4d& M_FN, const std::string& thing) {
    const double scale = M_FN.topLeftCorner<3, 3>().colwise().norm().maxCoeff();
    const double spacing_m = Spacing(largest) * scale;
    if (!(spacing_m >= kCoarse_m)) return;
    notes_.Add(fmt::format("the file has its place in single precision, far from its node, and "
                           "knows it to {:.1g} m only",
                           spacing_m),
               thing);
  }

  const AlignedBox3d& BoxOf(int positions) {
    const auto [entry, is_new] = boxes_.try_emplace(positions);
    if (is_new) {
      for (const glm::vec3& p : ReadVec3(asset_, positions)) {
        entry->second.extend(Vector3d(p.x, p.y, p.z));
      }
    }
    return entry->second;
  }

  const Asset& asset_;
  Notes& notes_;
  std::map<int, AlignedBox3d> boxes_;
  std::vector<Body> bodies_;
};

// Along each axis, half of the triangles belong to bodies whose middle is no further.
Vector3d MedianPlace(const std::vector<Body>& bodies) {
  Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::pair<double, double>> middles;
    double sum = 0.0;
    for (const Body& body : bodies) {
      middles.emplace_back(body.box_F.center()[axis], body.triangles);
      sum += body.triangles;
    }
    std::ranges::sort(middles);
    double passed = 0.0;
    for (const auto& [middle, triangles] : middles) {
      median[axis] = middle;
      passed += triangles;
      if (2.0 * passed >= sum) break;
    }
  }
  return median;
}

std::optional<Vector3d> TargetPlace(const Asset& asset, const std::vector<PlacedNode>& nodes,
                                    const std::vector<Body>& bodies,
                                    const std::optional<std::string>& target_node) {
  for (size_t i = 0; i < nodes.size(); ++i) {
    const tinygltf::Node& node = asset.model.nodes[nodes[i].node];
    const bool is_marked = Find(node.extras, {"fenestra", "target_window"}) != nullptr;
    if (target_node ? node.name != *target_node : !is_marked) continue;
    if (is_marked) return nodes[i].M_WN.topRightCorner<3, 1>();
    AlignedBox3d box_F;
    for (const Body& body : bodies) {
      if (body.placed >= i && body.placed < nodes[i].subtree_end) box_F.extend(body.box_F);
    }
    if (!box_F.isEmpty()) return box_F.center();
  }
  return std::nullopt;
}

std::optional<Vector3d> CameraPlace(const Asset& asset, const std::vector<PlacedNode>& nodes) {
  for (const PlacedNode& placed : nodes) {
    if (asset.model.nodes[placed.node].camera >= 0) return placed.M_WN.topRightCorner<3, 1>();
  }
  return std::nullopt;
}

}  // namespace

Vector3d ChooseOrigin(const Asset& asset, const std::vector<PlacedNode>& nodes,
                      const std::optional<std::string>& target_node, Notes& notes) {
  const Survey survey(asset, nodes, notes);
  std::optional<Vector3d> middle = TargetPlace(asset, nodes, survey.bodies(), target_node);
  if (!middle && !survey.bodies().empty()) middle = MedianPlace(survey.bodies());
  if (!middle) middle = CameraPlace(asset, nodes);
  Vector3d p_FW = Vector3d::Zero();
  if (middle && middle->allFinite() && middle->cwiseAbs().maxCoeff() > kFarthestMiddle_m) {
    p_FW = middle->array().round();
    notes.Add(fmt::format("its coordinates are large; all poses are given from ({:.0f}, {:.0f}, "
                          "{:.0f}) m in the file's axes",
                          p_FW.x(), p_FW.y(), p_FW.z()),
              "the scene");
  }
  for (const Body& body : survey.bodies()) {
    const double reach_m = Largest({body.box_F.min() - p_FW, body.box_F.max() - p_FW});
    if (reach_m < kFarthestPart_m) continue;
    notes.Add(
        "it reaches so far from the rest that single precision and the start of shadows "
        "are off by more than a millimetre",
        survey.NameOf(body, nodes));
  }
  return p_FW;
}

std::vector<PlacedNode> MovedTo(const Vector3d& p_FW, std::vector<PlacedNode> nodes) {
  for (PlacedNode& placed : nodes) placed.M_WN.topRightCorner<3, 1>() -= p_FW;
  return nodes;
}

}  // namespace fenestra::gltf
