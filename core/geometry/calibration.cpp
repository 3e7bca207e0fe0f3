#include "core/geometry/calibration.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/geometry/calibration_entries.h"
#include "core/io/yaml_reader.h"

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int64_t kLargestSide = 16384;
constexpr double kLargestBaseline_m = 10.0;
constexpr double kLargestOffset_m = 2.0;  // From a depth camera to its colour camera.

// The numbers of a list, or of a list of rows, or of OpenCV's mapping with rows, cols and data.
std::optional<std::vector<double>> ReadNumbers(YamlReader& reader, const YAML::Node& node,
                                               const std::string& name, size_t count) {
  if (node.IsMap() && node["data"].IsDefined()) {
    return reader.Numbers(node["data"], name + ".data", count);
  }
  if (!node.IsSequence() || node.size() == 0 || !node[0].IsSequence()) {
    return reader.Numbers(node, name, count);
  }
  YAML::Node flat;
  for (const YAML::Node& row : node) {
    if (!row.IsSequence()) return reader.Numbers(node, name, count);
    for (const YAML::Node& number : row) flat.push_back(number);
  }
  if (count == 0 || flat.size() == count) return reader.Numbers(flat, name, count);
  reader.AddFault(node, fmt::format("{} must have {} numbers, not {}", name, count, flat.size()));
  return std::nullopt;
}

std::vector<double> ReadMatrix(YamlReader& reader, const std::string& name, size_t rows,
                               size_t cols) {
  const YAML::Node node = reader.root()[name];
  const std::vector<double> fallback(rows * cols, 0.0);
  if (!node.IsDefined()) {
    reader.AddFault(reader.root(),
                    fmt::format("{} is missing: a {} x {} matrix", name, rows, cols));
    return fallback;
  }
  return ReadNumbers(reader, node, name, rows * cols).value_or(fallback);
}

// Distortion vectors come with 4, 5 or more entries; what a Brown–Conrady lens cannot express must
// be zero.
BrownConrady ReadDistortion(YamlReader& reader, const std::string& name) {
  const YAML::Node node = reader.root()[name];
  if (!node.IsDefined()) {
    reader.AddFault(reader.root(), name + " is missing: k1 k2 p1 p2 [k3]");
    return {};
  }
  const auto values = ReadNumbers(reader, node, name, 0);
  if (!values) return {};
  const std::vector<double>& v = *values;
  if (v.size() < 4) {
    reader.AddFault(node, fmt::format("{} must have at least 4 numbers, not {}", name, v.size()));
    return {};
  }
  if (std::any_of(v.begin() + std::min<ptrdiff_t>(5, std::ssize(v)), v.end(),
                  [](double coefficient) { return coefficient != 0.0; })) {
    reader.AddFault(node, fmt::format("{} has {} numbers, as of a rational or thin-prism model: "
                                      "only k1 k2 p1 p2 k3 are read; the others must be 0",
                                      name, v.size()));
    return {};
  }
  return {.k1 = v[0], .k2 = v[1], .p1 = v[2], .p2 = v[3], .k3 = v.size() > 4 ? v[4] : 0.0};
}

int ReadSize(YamlReader& reader, const std::string& name) {
  const YAML::Node node = reader.root()[name];
  if (!node.IsDefined()) {
    reader.AddFault(reader.root(), name + " is missing: pixels");
    return 1;
  }
  return static_cast<int>(reader.Integer(node, name, 1, kLargestSide).value_or(1));
}

// Focal lengths in millimetres or as shares of the image, which other programs write, would be
// those of a lens that sees nearly everything. Returns whether they are plausible.
bool CheckFieldOfView(YamlReader& reader, const YAML::Node& at, const std::string& name,
                      const CameraParameters& p) {
  constexpr double kLargest_deg = 170.0;
  const double tangent = std::max(0.5 * p.width_px / p.fx_px, 0.5 * p.height_px / p.fy_px);
  const double field_deg = 2.0 * std::atan(tangent) * 180.0 / M_PI;
  if (field_deg <= kLargest_deg) return true;
  reader.AddFault(at, fmt::format("{}: focal lengths of {:g} and {:g} px make a field of view of "
                                  "{:.1f} deg; they are read in pixels, not in millimetres or as "
                                  "shares of the image",
                                  name, p.fx_px, p.fy_px, field_deg));
  return false;
}

CameraParameters FromMatrix(YamlReader& reader, const YAML::Node& at, const std::string& name,
                            int width_px, int height_px, std::span<const double> K,
                            const BrownConrady& distortion) {
  CameraParameters p{.width_px = width_px,
                     .height_px = height_px,
                     .fx_px = K[0],
                     .fy_px = K[4],
                     .cx_px = K[2],
                     .cy_px = K[5],
                     .distortion = distortion};
  const bool pinhole = K[0] > 0.0 && K[4] > 0.0 && K[1] == 0.0 && K[3] == 0.0 && K[6] == 0.0 &&
                       K[7] == 0.0 && K[8] == 1.0;
  if (!pinhole && reader.fault_count() == 0) {
    reader.AddFault(at, name + " must be [fx 0 cx; 0 fy cy; 0 0 1] with positive focal lengths");
  }
  if (!pinhole || !CheckFieldOfView(reader, at, name, p)) {
    p = {.width_px = 1, .height_px = 1, .fx_px = 1, .fy_px = 1, .distortion = {}};
  }
  return p;
}

CameraModel ReadCamera(YamlReader& reader, const std::string& size_prefix, const std::string& K,
                       const std::string& D) {
  const int width_px = ReadSize(reader, size_prefix + "_width");
  const int height_px = ReadSize(reader, size_prefix + "_height");
  const std::vector<double> matrix = ReadMatrix(reader, K, 3, 3);
  const BrownConrady distortion = ReadDistortion(reader, D);
  return CameraModel(
      FromMatrix(reader, reader.root()[K], K, width_px, height_px, matrix, distortion));
}

Pose ReadPose(YamlReader& reader) {
  const std::vector<double> R = ReadMatrix(reader, "R", 3, 3);
  const std::vector<double> T = ReadMatrix(reader, "T", 3, 1);
  const Matrix3d rotation =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.data());
  const double deviation = (rotation * rotation.transpose() - Matrix3d::Identity()).norm();
  if (reader.fault_count() > 0) return Pose();
  if (!(deviation < 1e-5) || !(rotation.determinant() > 0.0)) {
    reader.AddFault(reader.root()["R"], "R must be a rotation matrix");
    return Pose();
  }
  // Files of other programs have fewer digits than a Pose demands; a matrix that is good enough
  // stays as it is, to the bit.
  Matrix3d nearest = rotation;
  if (deviation > 1e-10) {
    const Eigen::JacobiSVD<Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
    nearest = svd.matrixU() * svd.matrixV().transpose();
  }
  return Pose(nearest, Vector3d(T[0], T[1], T[2]));
}

// Farther apart than cameras of such a sensor are: most likely not in metres.
void CheckDistance(YamlReader& reader, const Pose& pose, double most_m) {
  const double distance_m = pose.translation().norm();
  if (distance_m <= most_m) return;
  reader.AddFault(reader.root()["T"],
                  fmt::format("T: the cameras would be {:g} m apart, and at most {:g} m are read: "
                              "is T in millimetres? It is read in metres",
                              distance_m, most_m));
}

YamlReader ReadDocument(const std::filesystem::path& file) {
  YamlReader reader = YamlReader::FromFile(file);
  CheckFormat(reader);
  CheckStatements(reader);
  return reader;
}

std::string Matrix(const std::string& name, int rows, int cols, std::span<const double> data) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n",
                     name, rows, cols, fmt::join(data, ", "));
}

std::string CameraYaml(const CameraModel& camera, const std::string& K, const std::string& D) {
  const CameraParameters& p = camera.parameters();
  const BrownConrady& d = p.distortion;
  const std::array<double, 9> k = {p.fx_px, 0.0, p.cx_px, 0.0, p.fy_px, p.cy_px, 0.0, 0.0, 1.0};
  const std::array<double, 5> dist = {d.k1, d.k2, d.p1, d.p2, d.k3};
  return Matrix(K, 3, 3, k) + Matrix(D, 1, 5, dist);
}

std::string PoseYaml(const Pose& X) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = X.rotation();
  return Matrix("R", 3, 3, {R.data(), 9}) + Matrix("T", 3, 1, {X.translation().data(), 3});
}

std::string SizeYaml(const std::string& prefix, const CameraModel& camera) {
  return fmt::format("{0}_width: {1}\n{0}_height: {2}\n", prefix, camera.width_px(),
                     camera.height_px());
}

}  // namespace

StereoCalibration ReadStereoCalibration(const std::filesystem::path& file) {
  YamlReader reader = ReadDocument(file);
  const CameraModel left = ReadCamera(reader, "image", "K1", "D1");
  const CameraModel right = ReadCamera(reader, "image", "K2", "D2");
  const Pose X_RL = ReadPose(reader);
  reader.ThrowIfFaulty();
  if (X_RL.translation().norm() == 0.0) {
    reader.AddFault(reader.root()["T"], "T must not be zero: the cameras need a baseline");
  }
  CheckDistance(reader, X_RL, kLargestBaseline_m);
  reader.ThrowIfFaulty();
  return {left, right, X_RL};
}

RgbdCalibration ReadRgbdCalibration(const std::filesystem::path& file) {
  YamlReader reader = ReadDocument(file);
  const CameraModel color = ReadCamera(reader, "color", "K_color", "D_color");
  const CameraModel depth = ReadCamera(reader, "depth", "K_depth", "D_depth");
  const Pose X_KD = ReadPose(reader);
  CheckDistance(reader, X_KD, kLargestOffset_m);
  CheckDepthUnitIsStatedAsKnown(reader);
  double depth_unit_m = 0.001;
  if (const YAML::Node node = reader.root()["depth_unit_m"]; node.IsDefined()) {
    const auto value = reader.Number(node, "depth_unit_m");
    depth_unit_m = value.value_or(depth_unit_m);
    if (const auto objection = DepthUnitObjection(depth_unit_m)) {
      reader.AddFault(node, "depth_unit_m: " + *objection);
    }
  }
  reader.ThrowIfFaulty();
  return {color, depth, X_KD, depth_unit_m};
}

std::string ToOpenCvYaml(const StereoCalibration& calibration) {
  return "%YAML:1.0\n---\n" + SizeYaml("image", calibration.left) +
         CameraYaml(calibration.left, "K1", "D1") + CameraYaml(calibration.right, "K2", "D2") +
         PoseYaml(calibration.X_RL);
}

std::string ToOpenCvYaml(const RgbdCalibration& calibration) {
  return "%YAML:1.0\n---\n" + SizeYaml("color", calibration.color) +
         CameraYaml(calibration.color, "K_color", "D_color") +
         SizeYaml("depth", calibration.depth) +
         CameraYaml(calibration.depth, "K_depth", "D_depth") + PoseYaml(calibration.X_KD) +
         fmt::format("depth_unit_m: {}\n", calibration.depth_unit_m);
}

std::string ToRosCameraInfo(const CameraModel& camera, const std::string& camera_name) {
  RosRectification alone{.rotation = Matrix3d::Identity(), .projection = {}};
  alone.projection << camera.Matrix(), Vector3d::Zero();
  return ToRosCameraInfo(camera, camera_name, alone);
}

std::string ToRosCameraInfo(const CameraModel& camera, const std::string& camera_name,
                            const RosRectification& rectification) {
  const CameraParameters& p = camera.parameters();
  const BrownConrady& d = p.distortion;
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = rectification.rotation;
  const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> P = rectification.projection;
  return fmt::format(
      "image_width: {}\nimage_height: {}\ncamera_name: {}\n"
      "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [{}, 0, {}, 0, {}, {}, 0, 0, 1]\n"
      "distortion_model: plumb_bob\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [{}, {}, {}, {}, {}]\n"
      "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [{}]\n"
      "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [{}]\n",
      p.width_px, p.height_px, camera_name, p.fx_px, p.cx_px, p.fy_px, p.cy_px, d.k1, d.k2, d.p1,
      d.p2, d.k3, fmt::join(R.data(), R.data() + R.size(), ", "),
      fmt::join(P.data(), P.data() + P.size(), ", "));
}

CameraModel ReadCameraInfo(const std::filesystem::path& file) {
  YamlReader reader = YamlReader::FromFile(file);
  if (!reader.root().IsMap()) reader.AddFault(reader.root(), "must be a mapping of entries");
  reader.ThrowIfFaulty();
  CheckStatements(reader);
  const int width_px = ReadSize(reader, "image_width");
  const int height_px = ReadSize(reader, "image_height");
  const std::vector<double> K = ReadMatrix(reader, "camera_matrix", 3, 3);
  const BrownConrady distortion = ReadDistortion(reader, "distortion_coefficients");
  const CameraParameters parameters = FromMatrix(
      reader, reader.root()["camera_matrix"], "camera_matrix", width_px, height_px, K, distortion);
  reader.ThrowIfFaulty();
  return CameraModel(parameters);
}

}  // namespace fenestra
