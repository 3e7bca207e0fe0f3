#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "scenes/gltf/file/document.h"
#include "scenes/gltf/validation/structure_check.h"

namespace fenestra::gltf {
namespace {

using Attributes = std::map<std::string, int>;

enum class Format {
  kFloat,
  kUByte,
  kUShort,
  kNormUByte,
  kNormUShort,
  kByte,
  kShort,
  kNormByte,
  kNormShort,
  kOther
};

Format FormatOf(const tinygltf::Accessor& accessor) {
  const bool n = accessor.normalized;
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return n ? Format::kOther : Format::kFloat;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return n ? Format::kNormUByte : Format::kUByte;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return n ? Format::kNormUShort : Format::kUShort;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return n ? Format::kNormByte : Format::kByte;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return n ? Format::kNormShort : Format::kShort;
    default:
      return Format::kOther;
  }
}

// The allowed formats of a vertex attribute: section 3.7.2.1 of the specification and, where a file
// declares it, KHR_mesh_quantization.
struct AttributeRule {
  std::set<int> types;
  std::set<Format> formats;
  std::set<Format> quantized;
};

const AttributeRule* RuleFor(std::string_view semantic) {
  using enum Format;
  static const std::map<std::string_view, AttributeRule> kRules = {
      {"POSITION",
       {{TINYGLTF_TYPE_VEC3},
        {kFloat},
        {kByte, kNormByte, kUByte, kNormUByte, kShort, kNormShort, kUShort, kNormUShort}}},
      {"NORMAL", {{TINYGLTF_TYPE_VEC3}, {kFloat}, {kNormByte, kNormShort}}},
      // VEC3 in morph targets.
      {"TANGENT", {{TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4}, {kFloat}, {kNormByte, kNormShort}}},
      {"TEXCOORD",
       {{TINYGLTF_TYPE_VEC2},
        {kFloat, kNormUByte, kNormUShort},
        {kByte, kNormByte, kUByte, kShort, kNormShort, kUShort}}},
      {"COLOR", {{TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4}, {kFloat, kNormUByte, kNormUShort}, {}}},
      {"JOINTS", {{TINYGLTF_TYPE_VEC4}, {kUByte, kUShort}, {}}},
      {"WEIGHTS", {{TINYGLTF_TYPE_VEC4}, {kFloat, kNormUByte, kNormUShort}, {}}}};
  const auto found = kRules.find(semantic);
  return found == kRules.end() ? nullptr : &found->second;
}

// "TEXCOORD" of "TEXCOORD_1"; empty where the specification knows no such attribute.
std::string_view Semantic(std::string_view name) {
  if (name == "POSITION" || name == "NORMAL" || name == "TANGENT") return name;
  const size_t underscore = name.find('_');
  if (underscore == name.npos) return {};
  const std::string_view set = name.substr(underscore + 1);
  const bool numbered = !set.empty() && set.size() <= 2 &&
                        std::ranges::all_of(set, [](char c) { return c >= '0' && c <= '9'; });
  const std::string_view semantic = name.substr(0, underscore);
  const bool takes_number = semantic == "TEXCOORD" || semantic == "COLOR" || semantic == "JOINTS" ||
                            semantic == "WEIGHTS";
  return numbered && takes_number ? semantic : std::string_view();
}

class MeshCheck {
 public:
  MeshCheck(const tinygltf::Model& model, Faults& faults)
      : model_(model),
        quantized_(std::ranges::find(model.extensionsUsed, "KHR_mesh_quantization") !=
                   model.extensionsUsed.end()),
        faults_(faults) {}

  void Mesh(const tinygltf::Mesh& mesh, const std::string& at);
  void SharedViews();

 private:
  const tinygltf::Accessor& AccessorAt(int index) const {
    return model_.accessors[static_cast<size_t>(index)];
  }
  void Primitive(const tinygltf::Primitive& primitive, const std::string& at);
  void Indices(int index, const std::string& at);
  void VertexData(const Attributes& attributes, size_t count, const std::string& at);
  void Attribute(const std::string& name, int index, const std::string& at);

  const tinygltf::Model& model_;
  const bool quantized_;
  Faults& faults_;
  std::map<int, std::set<int>> accessors_of_view_;  // Those that hold vertices.
};

void MeshCheck::Mesh(const tinygltf::Mesh& mesh, const std::string& at) {
  const size_t targets = mesh.primitives.front().targets.size();
  for (size_t i = 0; i < mesh.primitives.size(); ++i) {
    const std::string pointer = fmt::format("{}/primitives/{}", at, i);
    Primitive(mesh.primitives[i], pointer);
    if (mesh.primitives[i].targets.size() != targets) {
      faults_.Add(pointer + "/targets", fmt::format("must be {} as in the mesh's first primitive, "
                                                    "not {}",
                                                    targets, mesh.primitives[i].targets.size()));
    }
  }
  if (!mesh.weights.empty() && mesh.weights.size() != targets) {
    faults_.Add(at + "/weights",
                fmt::format("{} weights for {} morph targets", mesh.weights.size(), targets));
  }
}

void MeshCheck::Primitive(const tinygltf::Primitive& primitive, const std::string& at) {
  if (primitive.indices >= 0) Indices(primitive.indices, at + "/indices");
  const size_t count = AccessorAt(primitive.attributes.begin()->second).count;
  VertexData(primitive.attributes, count, at + "/attributes");
  for (size_t i = 0; i < primitive.targets.size(); ++i) {
    const std::string pointer = fmt::format("{}/targets/{}", at, i);
    VertexData(primitive.targets[i], count, pointer);
    for (const auto& [name, index] : primitive.targets[i]) {
      if (primitive.attributes.contains(name)) continue;
      faults_.Add(pointer + MemberPointer(name), "is not among the primitive's attributes");
    }
  }
  const auto sets = [&](std::string_view semantic) {
    return std::ranges::count_if(primitive.attributes, [&](const auto& attribute) {
      return Semantic(attribute.first) == semantic;
    });
  };
  if (sets("JOINTS") != sets("WEIGHTS")) {
    faults_.Add(at + "/attributes", fmt::format("{} JOINTS and {} WEIGHTS do not go together",
                                                sets("JOINTS"), sets("WEIGHTS")));
  }
}

void MeshCheck::Indices(int index, const std::string& at) {
  const tinygltf::Accessor& accessor = AccessorAt(index);
  const Format format = FormatOf(accessor);
  const bool is_unsigned =
      format == Format::kUByte || format == Format::kUShort ||
      (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT && !accessor.normalized);
  if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_unsigned) {
    faults_.Add(at, fmt::format("/accessors/{} must be unsigned scalars", index));
  }
  if (accessor.bufferView >= 0 &&
      model_.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride != 0) {
    faults_.Add(at, fmt::format("/bufferViews/{} must not have a stride", accessor.bufferView));
  }
}

void MeshCheck::VertexData(const Attributes& attributes, size_t count, const std::string& at) {
  for (const auto& [name, index] : attributes) {
    const std::string pointer = at + MemberPointer(name);
    Attribute(name, index, pointer);
    if (AccessorAt(index).count == count) continue;
    faults_.Add(pointer, fmt::format("has {} elements, while another attribute has {}",
                                     AccessorAt(index).count, count));
  }
}

void MeshCheck::Attribute(const std::string& name, int index, const std::string& at) {
  const tinygltf::Accessor& accessor = AccessorAt(index);
  if (accessor.bufferView >= 0) accessors_of_view_[accessor.bufferView].insert(index);
  const ElementLayout layout = LayoutOf(accessor.componentType, accessor.type);
  const size_t stride =
      accessor.bufferView < 0
          ? 0
          : model_.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
  if (accessor.byteOffset % 4 != 0 || (stride == 0 && layout.PackedStride() % 4 != 0)) {
    faults_.Add(
        at, fmt::format("the vertices of /accessors/{} must begin at multiples of 4 bytes", index));
  }
  if (name.starts_with('_')) return;  // An application's own attribute.
  const AttributeRule* rule = RuleFor(Semantic(name));
  if (rule == nullptr) return faults_.Add(at, "is not an attribute of glTF 2.0");
  const Format format = FormatOf(accessor);
  if (!rule->types.contains(accessor.type) ||
      !(rule->formats.contains(format) || (quantized_ && rule->quantized.contains(format)))) {
    faults_.Add(at, fmt::format("/accessors/{} has a type that is not allowed for it", index));
  }
  if (name == "POSITION" && (accessor.minValues.empty() || accessor.maxValues.empty())) {
    faults_.Add(at, fmt::format("/accessors/{} must have 'min' and 'max'", index));
  }
}

// Two kinds of vertex data in one view are interleaved, and only a stated stride says how.
void MeshCheck::SharedViews() {
  for (const auto& [view, accessors] : accessors_of_view_) {
    if (accessors.size() < 2 || model_.bufferViews[static_cast<size_t>(view)].byteStride != 0) {
      continue;
    }
    faults_.Add(fmt::format("/bufferViews/{}", view),
                fmt::format("{} accessors of vertices share it, so it must have a byteStride",
                            accessors.size()));
  }
}

}  // namespace

void CheckMeshes(const tinygltf::Model& model, Faults& faults) {
  MeshCheck check(model, faults);
  for (size_t i = 0; i < model.meshes.size(); ++i) {
    check.Mesh(model.meshes[i], fmt::format("/meshes/{}", i));
  }
  check.SharedViews();
}

}  // namespace fenestra::gltf
