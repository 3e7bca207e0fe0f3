#include "scenes/gltf/writer/node_writer.h"

#include <cmath>

#include "scenes/gltf/reader/cameras_and_lights.h"
#include "scenes/gltf/writer/material_writer.h"

namespace fenestra::gltf {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using tinygltf::Value;

// Clipping planes, which viewers need; Fenestra has none.
constexpr double kNear_m = 0.01;
constexpr double kFar_m = 1000.0;

void AddNode(tinygltf::Node node, tinygltf::Model& model) {
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
  model.nodes.push_back(std::move(node));
}

Value Ours(Value::Object members) {
  return Value(Value::Object{{"fenestra", Value(std::move(members))}});
}

// As a matrix, column by column: a quaternion would round.
std::vector<double> NodeMatrix(const Eigen::Matrix3d& R_WN, const Vector3d& p_WN) {
  Matrix4d M = Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = R_WN;
  M.topRightCorner<3, 1>() = p_WN;
  return {M.data(), M.data() + M.size()};
}

// Axes of which +z is the given unit vector, to the bit.
Eigen::Matrix3d AxesWithZ(const Vector3d& z_W) {
  Eigen::Matrix3d R;
  R.col(0) = z_W.unitOrthogonal();
  R.col(1) = z_W.cross(R.col(0));
  R.col(2) = z_W;
  return R;
}

void WriteWindow(const TargetWindow& window, const char* role, tinygltf::Model& model) {
  tinygltf::Node node;
  node.name = role;
  node.matrix = NodeMatrix(window.X_WO.rotation(), window.X_WO.translation());
  node.extras = Ours({{role, Value(Value::Object{{"width_m", Value(window.width_m)},
                                                 {"height_m", Value(window.height_m)}})}});
  AddNode(std::move(node), model);
}

Value CameraExtras(const CameraParameters& p) {
  const BrownConrady& d = p.distortion;
  Value::Array distortion;
  for (const double k : {d.k1, d.k2, d.p1, d.p2, d.k3}) distortion.emplace_back(k);
  return Ours({{"width_px", Value(p.width_px)},
               {"height_px", Value(p.height_px)},
               {"fx_px", Value(p.fx_px)},
               {"fy_px", Value(p.fy_px)},
               {"cx_px", Value(p.cx_px)},
               {"cy_px", Value(p.cy_px)},
               {"distortion", Value(std::move(distortion))}});
}

void AddLight(tinygltf::Light light, tinygltf::Node node, tinygltf::Model& model) {
  node.name = light.name;
  node.extensions["KHR_lights_punctual"] =
      Value(Value::Object{{"light", Value(static_cast<int>(model.lights.size()))}});
  model.lights.push_back(std::move(light));
  AddNode(std::move(node), model);
}

void WriteSun(const Sun& sun, tinygltf::Model& model) {
  tinygltf::Light light;
  light.name = "sun";
  light.type = "directional";
  light.color = {1.0, 1.0, 1.0};
  light.intensity = sun.illuminance_lx;
  tinygltf::Node node;
  node.matrix = NodeMatrix(AxesWithZ(sun.Direction_W().normalized()), Vector3d::Zero());
  AddLight(std::move(light), std::move(node), model);
}

void WriteLamp(const Lamp& lamp, tinygltf::Model& model) {
  const ScaledLight intensity = SplitScale(lamp.intensity_rgb);
  tinygltf::Light light;
  light.name = lamp.name;
  light.type = lamp.cone ? "spot" : "point";
  light.color = intensity.fraction;
  light.intensity = intensity.scale;
  if (lamp.irradiance_830_per_lux != 0.0) {
    light.extras = Ours({{"irradiance_830_per_lux", Value(lamp.irradiance_830_per_lux)}});
  }
  tinygltf::Node node;
  if (lamp.cone) {
    light.spot.innerConeAngle = lamp.cone->inner_rad;
    light.spot.outerConeAngle = lamp.cone->outer_rad;
    node.matrix = NodeMatrix(AxesWithZ(-lamp.cone->axis_W), lamp.p_WL);
  } else {
    node.translation = {lamp.p_WL.x(), lamp.p_WL.y(), lamp.p_WL.z()};
  }
  AddLight(std::move(light), std::move(node), model);
}

}  // namespace

void WriteMeshes(const Scene& scene, tinygltf::Model& model, BufferBuilder& buffer) {
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.triangles.empty()) continue;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = static_cast<int>(mesh.material);
    primitive.attributes["POSITION"] = buffer.AddVertices(mesh.positions_W);
    if (!mesh.normals_W.empty()) {
      primitive.attributes["NORMAL"] = buffer.AddVertices(mesh.normals_W);
    }
    if (!mesh.texture_coordinates.empty() && scene.materials[mesh.material].texture) {
      primitive.attributes["TEXCOORD_0"] = buffer.AddVertices(mesh.texture_coordinates);
    }
    if (!mesh.colors.empty()) primitive.attributes["COLOR_0"] = buffer.AddVertices(mesh.colors);
    primitive.indices = buffer.AddTriangles(mesh.triangles);
    tinygltf::Mesh out;
    out.name = mesh.name;
    out.primitives.push_back(std::move(primitive));
    if (mesh.closed) out.extras = Ours({{"closed", Value(true)}});
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(std::move(out));
    AddNode(std::move(node), model);
  }
}

void WriteWindows(const Scene& scene, tinygltf::Model& model) {
  if (scene.target) WriteWindow(*scene.target, "target_window", model);
  for (const TargetWindow& window : scene.other_windows) WriteWindow(window, "other_window", model);
}

void WriteCameras(const std::vector<SceneCamera>& cameras, tinygltf::Model& model) {
  for (const SceneCamera& camera : cameras) {
    const CameraParameters& p = camera.model.parameters();
    tinygltf::Camera out;
    out.name = camera.name;
    out.type = "perspective";
    out.perspective.yfov = 2.0 * std::atan(0.5 * p.height_px / p.fy_px);
    out.perspective.aspectRatio = p.width_px * p.fy_px / (p.height_px * p.fx_px);
    out.perspective.znear = kNear_m;
    out.perspective.zfar = kFar_m;
    out.extras = CameraExtras(p);
    tinygltf::Node node;
    node.name = camera.name;
    node.camera = static_cast<int>(model.cameras.size());
    const Pose X_WG = FlipCameraAxes(camera.X_WC);
    node.matrix = NodeMatrix(X_WG.rotation(), X_WG.translation());
    model.cameras.push_back(std::move(out));
    AddNode(std::move(node), model);
  }
}

void WriteLights(const GltfScene& scene, tinygltf::Model& model) {
  if (scene.sun) WriteSun(*scene.sun, model);
  for (const Lamp& lamp : scene.scene.lamps) WriteLamp(lamp, model);
}

}  // namespace fenestra::gltf
