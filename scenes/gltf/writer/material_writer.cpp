#include "scenes/gltf/writer/material_writer.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/system/check.h"

namespace fenestra::gltf {
namespace {

constexpr int kNoTarget = 0;

template <typename T>
std::span<const uint8_t> BytesOf(const std::vector<T>& values) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
  return {reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)};
}

// The least and the largest of each component.
template <typename Vector>
void SetBounds(const std::vector<Vector>& values, tinygltf::Accessor& accessor) {
  for (glm::length_t i = 0; i < Vector::length(); ++i) {
    const auto [low, high] = std::ranges::minmax(values, {}, [i](const Vector& v) { return v[i]; });
    accessor.minValues.push_back(low[i]);
    accessor.maxValues.push_back(high[i]);
  }
}

using tinygltf::Value;

int WrapCode(Texture::Wrap wrap) {
  switch (wrap) {
    case Texture::Wrap::kClampToEdge:
      return TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    case Texture::Wrap::kMirroredRepeat:
      return TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
    case Texture::Wrap::kRepeat:
      break;
  }
  return TINYGLTF_TEXTURE_WRAP_REPEAT;
}

std::vector<unsigned char> EncodePng(const Texture& texture) {
  cv::Mat4b bgra(texture.height_px, texture.width_px);
  std::ranges::transform(texture.texels, bgra.begin(),
                         [](const glm::u8vec4& t) { return cv::Vec4b(t.b, t.g, t.r, t.a); });
  std::vector<unsigned char> bytes;
  FENESTRA_CHECK(cv::imencode(".png", bgra, bytes), "any 8-bit picture is a PNG");
  return bytes;
}

void WriteGlass(const Material& material, tinygltf::Model& model, tinygltf::Material& out) {
  out.extensions["KHR_materials_transmission"] =
      Value(Value::Object{{"transmissionFactor", Value(1.0)}});
  out.extensions["KHR_materials_ior"] =
      Value(Value::Object{{"ior", Value(double{material.refractive_index})}});
  out.pbrMetallicRoughness.roughnessFactor = 0.0;
  out.doubleSided = true;
  Declare("KHR_materials_transmission", model);
  Declare("KHR_materials_ior", model);
}

void WriteEmission(const Material& material, tinygltf::Model& model, tinygltf::Material& out) {
  if (material.emission_rgb == glm::vec3(0.0f)) return;
  const ScaledLight emission = SplitScale(material.emission_rgb);
  out.emissiveFactor = emission.fraction;
  if (material.texture) out.emissiveTexture.index = static_cast<int>(*material.texture);
  if (emission.scale == 1.0) return;
  out.extensions["KHR_materials_emissive_strength"] =
      Value(Value::Object{{"emissiveStrength", Value(emission.scale)}});
  Declare("KHR_materials_emissive_strength", model);
}

void WritePaint(const Material& material, tinygltf::Model& model, tinygltf::Material& out) {
  const glm::vec3& rgb = material.reflectance_rgb;
  out.pbrMetallicRoughness.baseColorFactor = {rgb.r, rgb.g, rgb.b, 1.0};
  if (material.texture) {
    out.pbrMetallicRoughness.baseColorTexture.index = static_cast<int>(*material.texture);
  }
  WriteEmission(material, model, out);
  if (material.alpha_cutoff > 0.0f) {
    out.alphaMode = "MASK";
    out.alphaCutoff = material.alpha_cutoff;
  }
  Value::Object ours{{"reflectance_830nm", Value(double{material.reflectance_830nm})}};
  if (material.emission_830nm != 0.0f) {
    ours["emission_830nm"] = Value(double{material.emission_830nm});
  }
  out.extras = Value(Value::Object{{"fenestra", Value(std::move(ours))}});
}

}  // namespace

int BufferBuilder::AddVertices(const std::vector<glm::vec3>& values) {
  tinygltf::Accessor accessor;
  accessor.bufferView = AddView(BytesOf(values), TINYGLTF_TARGET_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = TINYGLTF_TYPE_VEC3;
  accessor.count = values.size();
  SetBounds(values, accessor);
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int BufferBuilder::AddVertices(const std::vector<glm::vec2>& values) {
  tinygltf::Accessor accessor;
  accessor.bufferView = AddView(BytesOf(values), TINYGLTF_TARGET_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = TINYGLTF_TYPE_VEC2;
  accessor.count = values.size();
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int BufferBuilder::AddTriangles(const std::vector<glm::uvec3>& triangles) {
  tinygltf::Accessor accessor;
  accessor.bufferView = AddView(BytesOf(triangles), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.count = 3 * triangles.size();
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int BufferBuilder::AddBytes(std::span<const uint8_t> bytes) {
  return AddView(bytes, kNoTarget);
}

int BufferBuilder::AddView(std::span<const uint8_t> bytes, int target) {
  std::vector<unsigned char>& data = model_.buffers[0].data;
  data.resize((data.size() + 3) / 4 * 4);  // All our components have 4 bytes.
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = bytes.size();
  view.target = target;
  data.insert(data.end(), bytes.begin(), bytes.end());
  model_.bufferViews.push_back(std::move(view));
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

void Declare(const std::string& extension, tinygltf::Model& model) {
  std::vector<std::string>& used = model.extensionsUsed;
  if (std::ranges::find(used, extension) == used.end()) used.push_back(extension);
}

ScaledLight SplitScale(const glm::vec3& light) {
  ScaledLight split;
  const double most = std::max({light.r, light.g, light.b});
  if (most > 1.0) {
    int exponent = 0;
    std::frexp(most, &exponent);  // most <= 2^exponent.
    split.scale = std::ldexp(1.0, exponent);
  }
  split.fraction = {light.r / split.scale, light.g / split.scale, light.b / split.scale};
  return split;
}

void WriteTextures(const Scene& scene, tinygltf::Model& model, BufferBuilder& buffer) {
  for (const Texture& texture : scene.textures) {
    tinygltf::Image image;
    image.name = texture.name;
    image.mimeType = "image/png";
    image.bufferView = buffer.AddBytes(EncodePng(texture));
    tinygltf::Sampler sampler;
    sampler.wrapS = WrapCode(texture.wrap_u);
    sampler.wrapT = WrapCode(texture.wrap_v);
    sampler.magFilter =
        texture.interpolated ? TINYGLTF_TEXTURE_FILTER_LINEAR : TINYGLTF_TEXTURE_FILTER_NEAREST;
    sampler.minFilter = texture.interpolated ? TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR
                                             : TINYGLTF_TEXTURE_FILTER_NEAREST;
    tinygltf::Texture out;
    out.name = texture.name;
    out.source = static_cast<int>(model.images.size());
    out.sampler = static_cast<int>(model.samplers.size());
    model.images.push_back(std::move(image));
    model.samplers.push_back(std::move(sampler));
    model.textures.push_back(std::move(out));
  }
}

void WriteMaterials(const Scene& scene, tinygltf::Model& model) {
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    tinygltf::Material out;
    out.name = material.name;
    out.pbrMetallicRoughness.metallicFactor = 0.0;
    // It is a property of materials in glTF, but of meshes in Fenestra.
    out.doubleSided = std::ranges::any_of(
        scene.meshes, [i](const Mesh& mesh) { return mesh.material == i && !mesh.closed; });
    if (material.kind == Material::Kind::kGlass) {
      WriteGlass(material, model, out);
    } else {
      WritePaint(material, model, out);
    }
    model.materials.push_back(std::move(out));
  }
}

}  // namespace fenestra::gltf
