#include "scenes/gltf/reader/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

#include "core/io/input_error.h"
#include "scenes/gltf/reader/accessors.h"

namespace fenestra::gltf {
namespace {

using Attributes = std::map<std::string, int>;

// Eight joints move a vertex at most; readers need not go beyond four.
constexpr int kMostJointSets = 2;

std::optional<int> Attribute(const Attributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? std::nullopt : std::optional(found->second);
}

size_t AccessorCount(const Asset& asset, int accessor) {
  return asset.model.accessors[static_cast<size_t>(accessor)].count;
}

std::vector<uint32_t> VertexIndices(const Asset& asset, const tinygltf::Primitive& primitive) {
  const size_t vertices = AccessorCount(asset, primitive.attributes.at("POSITION"));
  if (primitive.indices < 0) {
    std::vector<uint32_t> all(vertices);
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }
  std::vector<uint32_t> indices = ReadUnsigned(asset, primitive.indices);
  const auto bad = std::ranges::find_if(indices, [vertices](uint32_t i) { return i >= vertices; });
  if (bad != indices.end()) {
    throw InputError(asset.file,
                     fmt::format("/accessors/{}: element {} is vertex {}; there are {}",
                                 primitive.indices, bad - indices.begin(), *bad, vertices));
  }
  return indices;
}

// value + Σ weight · delta over the morph targets that have the attribute.
void Morph(const Asset& asset, const tinygltf::Primitive& primitive, const std::string& attribute,
           const std::vector<double>& weights, std::vector<glm::vec3>& values) {
  std::vector<glm::dvec3> sums(values.begin(), values.end());
  bool is_morphed = false;
  for (size_t i = 0; i < primitive.targets.size() && i < weights.size(); ++i) {
    const auto accessor = Attribute(primitive.targets[i], attribute);
    if (!accessor || weights[i] == 0.0) continue;
    is_morphed = true;
    const std::vector<glm::vec3> deltas = ReadVec3(asset, *accessor);
    for (size_t k = 0; k < sums.size(); ++k) sums[k] += weights[i] * glm::dvec3(deltas[k]);
  }
  if (is_morphed) values.assign(sums.begin(), sums.end());
}

std::vector<glm::vec3> ReadColors(const Asset& asset, int accessor, const std::string& name,
                                  Notes& notes) {
  std::vector<glm::vec3> colors;
  for (const glm::vec4& rgba : ReadVec4(asset, accessor)) {
    const glm::vec3 rgb(rgba);
    colors.push_back(glm::clamp(rgb, 0.0f, 1.0f));
    if (colors.back() != rgb) notes.Add("vertex colours are clamped to [0, 1]", name);
    if (rgba.a != 1.0f) notes.Add("the alpha of vertex colours is left out", name);
  }
  return colors;
}

std::vector<JointWeights> ReadJoints(const Asset& asset, const Attributes& attributes) {
  std::vector<JointWeights> sets;
  for (int set = 0; set < kMostJointSets; ++set) {
    const auto joints = Attribute(attributes, fmt::format("JOINTS_{}", set));
    const auto weights = Attribute(attributes, fmt::format("WEIGHTS_{}", set));
    if (!joints || !weights) break;
    sets.push_back({ReadVec4(asset, *joints), ReadVec4(asset, *weights)});
  }
  return sets;
}

}  // namespace

bool IsSurface(const tinygltf::Primitive& primitive) {
  return HasTriangles(primitive.mode) && primitive.attributes.contains("POSITION");
}

size_t ClaimedTriangles(const Asset& asset, const tinygltf::Primitive& primitive) {
  const int source =
      primitive.indices >= 0 ? primitive.indices : primitive.attributes.at("POSITION");
  return TriangleCount(primitive.mode, AccessorCount(asset, source));
}

size_t ClaimedVertices(const Asset& asset, const tinygltf::Primitive& primitive) {
  return AccessorCount(asset, primitive.attributes.at("POSITION")) * (1 + primitive.targets.size());
}

Surface ReadSurface(const Asset& asset, const tinygltf::Primitive& primitive,
                    const std::optional<TextureUse>& texture, const std::vector<double>& weights,
                    const std::string& name, Notes& notes) {
  const Attributes& attributes = primitive.attributes;
  Surface surface;
  surface.triangles = Triangles(primitive.mode, VertexIndices(asset, primitive));
  surface.positions_M = ReadVec3(asset, attributes.at("POSITION"));
  Morph(asset, primitive, "POSITION", weights, surface.positions_M);
  if (const auto normals = Attribute(attributes, "NORMAL")) {
    surface.normals_M = ReadVec3(asset, *normals);
    Morph(asset, primitive, "NORMAL", weights, surface.normals_M);
  }
  if (const auto colors = Attribute(attributes, "COLOR_0")) {
    surface.colors = ReadColors(asset, *colors, name, notes);
  }
  if (texture) {
    const auto set = fmt::format("TEXCOORD_{}", texture->coordinate_set);
    if (const auto coordinates = Attribute(attributes, set)) {
      surface.texture_coordinates = ReadVec2(asset, *coordinates);
      for (glm::vec2& uv : surface.texture_coordinates) uv = texture->Apply(uv);
    } else {
      notes.Add("without the coordinates of its texture, it is rendered without the texture", name);
    }
  }
  surface.joint_sets = ReadJoints(asset, attributes);
  return surface;
}

}  // namespace fenestra::gltf
