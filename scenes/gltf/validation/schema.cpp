#include "scenes/gltf/validation/schema.h"

namespace fenestra::gltf {
namespace {

// The tables below follow the JSON schema of the glTF 2.0.1 specification, object by object.

constexpr double kLargestSize = 9007199254740992.0;  // 2^53: beyond it JSON's integers blur.

Property Size(std::string_view name) {
  return Integer(name).AtLeast(0).AtMost(kLargestSize);
}

const ObjectSchema& Asset() {
  static const ObjectSchema schema{
      .properties = {String("version").Required(), String("minVersion")}};
  return schema;
}

// tinygltf holds the sizes of sparse accessors in 32 bits.
Property SparseSize(std::string_view name) {
  return Integer(name).AtLeast(0).AtMost(std::numeric_limits<int32_t>::max());
}

const ObjectSchema& SparseIndices() {
  static const ObjectSchema schema{
      .properties = {Reference("bufferView", "bufferViews").Required(), SparseSize("byteOffset"),
                     Code("componentType", {5121, 5123, 5125}).Required()}};
  return schema;
}

const ObjectSchema& SparseValues() {
  static const ObjectSchema schema{
      .properties = {Reference("bufferView", "bufferViews").Required(), SparseSize("byteOffset")}};
  return schema;
}

const ObjectSchema& Sparse() {
  static const ObjectSchema schema{.properties = {SparseSize("count").AtLeast(1).Required(),
                                                  Object("indices", SparseIndices()).Required(),
                                                  Object("values", SparseValues()).Required()}};
  return schema;
}

const ObjectSchema& Accessor() {
  static const ObjectSchema schema{
      .properties = {
          Reference("bufferView", "bufferViews"), Size("byteOffset").Needs("bufferView"),
          Code("componentType", {5120, 5121, 5122, 5123, 5125, 5126}).Required(),
          Boolean("normalized"), Size("count").AtLeast(1).Required(),
          Word("type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}).Required(),
          Number("max").Array(1, 16), Number("min").Array(1, 16), Object("sparse", Sparse()),
          String("name")}};
  return schema;
}

const ObjectSchema& AnimationTarget() {
  static const ObjectSchema schema{
      .properties = {Reference("node", "nodes"), String("path").Required()}};
  return schema;
}

const ObjectSchema& AnimationChannel() {
  static const ObjectSchema schema{
      .properties = {Size("sampler").Required(), Object("target", AnimationTarget()).Required()}};
  return schema;
}

const ObjectSchema& AnimationSampler() {
  static const ObjectSchema schema{.properties = {Reference("input", "accessors").Required(),
                                                  String("interpolation"),
                                                  Reference("output", "accessors").Required()}};
  return schema;
}

const ObjectSchema& Animation() {
  static const ObjectSchema schema{
      .properties = {Object("channels", AnimationChannel()).Array().Required(),
                     Object("samplers", AnimationSampler()).Array().Required(), String("name")}};
  return schema;
}

const ObjectSchema& Buffer() {
  static const ObjectSchema schema{
      .properties = {String("uri"), Size("byteLength").AtLeast(1).Required(), String("name")}};
  return schema;
}

const ObjectSchema& BufferView() {
  static const ObjectSchema schema{.properties = {Reference("buffer", "buffers").Required(),
                                                  Size("byteOffset"),
                                                  Size("byteLength").AtLeast(1).Required(),
                                                  Integer("byteStride").AtLeast(4).AtMost(252),
                                                  Code("target", {34962, 34963}), String("name")}};
  return schema;
}

const ObjectSchema& Orthographic() {
  static const ObjectSchema schema{
      .properties = {Number("xmag").Required(), Number("ymag").Required(),
                     Number("zfar").Above(0).Required(), Number("znear").AtLeast(0).Required()}};
  return schema;
}

const ObjectSchema& Perspective() {
  static const ObjectSchema schema{
      .properties = {Number("aspectRatio").Above(0), Number("yfov").Above(0).Required(),
                     Number("zfar").Above(0), Number("znear").Above(0).Required()}};
  return schema;
}

const ObjectSchema& Camera() {
  static const ObjectSchema schema{
      .properties = {Object("orthographic", Orthographic()), Object("perspective", Perspective()),
                     Word("type", {"perspective", "orthographic"}).Required(), String("name")},
      .extras = &schemas::CameraExtras()};
  return schema;
}

const ObjectSchema& Image() {
  static const ObjectSchema schema{.properties = {String("uri"), String("mimeType"),
                                                  Reference("bufferView", "bufferViews"),
                                                  String("name")}};
  return schema;
}

ObjectSchema TextureInfoWith(std::vector<Property> more) {
  ObjectSchema schema{
      .properties = {Reference("index", "textures").Required(), Size("texCoord").AtMost(15)},
      .extensions = {{"KHR_texture_transform", &schemas::TextureTransform()}}};
  schema.properties.insert(schema.properties.end(), more.begin(), more.end());
  return schema;
}

const ObjectSchema& TextureInfo() {
  static const ObjectSchema schema = TextureInfoWith({});
  return schema;
}

const ObjectSchema& NormalTextureInfo() {
  static const ObjectSchema schema = TextureInfoWith({Number("scale")});
  return schema;
}

const ObjectSchema& OcclusionTextureInfo() {
  static const ObjectSchema schema = TextureInfoWith({Number("strength").AtLeast(0).AtMost(1)});
  return schema;
}

const ObjectSchema& MetallicRoughness() {
  static const ObjectSchema schema{
      .properties = {Number("baseColorFactor").Array(4, 4).AtLeast(0).AtMost(1),
                     Object("baseColorTexture", TextureInfo()),
                     Number("metallicFactor").AtLeast(0).AtMost(1),
                     Number("roughnessFactor").AtLeast(0).AtMost(1),
                     Object("metallicRoughnessTexture", TextureInfo())}};
  return schema;
}

const ObjectSchema& Material() {
  static const ObjectSchema schema{
      .properties = {String("name"), Object("pbrMetallicRoughness", MetallicRoughness()),
                     Object("normalTexture", NormalTextureInfo()),
                     Object("occlusionTexture", OcclusionTextureInfo()),
                     Object("emissiveTexture", TextureInfo()),
                     Number("emissiveFactor").Array(3, 3).AtLeast(0).AtMost(1),
                     Word("alphaMode", {"OPAQUE", "MASK", "BLEND"}),
                     Number("alphaCutoff").AtLeast(0), Boolean("doubleSided")},
      .extensions = {{"KHR_materials_unlit", &schemas::Empty()},
                     {"KHR_materials_emissive_strength", &schemas::EmissiveStrength()},
                     {"KHR_materials_transmission", &schemas::Transmission()},
                     {"KHR_materials_ior", &schemas::IndexOfRefraction()}},
      .extras = &schemas::MaterialExtras()};
  return schema;
}

const ObjectSchema& Primitive() {
  static const ObjectSchema schema{
      .properties = {Object("attributes", schemas::Attributes()).Required(),
                     Reference("indices", "accessors"), Reference("material", "materials"),
                     Code("mode", {0, 1, 2, 3, 4, 5, 6}),
                     Object("targets", schemas::Attributes()).Array()}};
  return schema;
}

const ObjectSchema& Mesh() {
  static const ObjectSchema schema{
      .properties = {Object("primitives", Primitive()).Array().Required(),
                     Number("weights").Array(), String("name")},
      .extras = &schemas::MeshExtras()};
  return schema;
}

const ObjectSchema& Node() {
  static const ObjectSchema schema{
      .properties = {Reference("camera", "cameras"),
                     Reference("children", "nodes").Array().Unique(), Reference("skin", "skins"),
                     Number("matrix").Array(16, 16), Reference("mesh", "meshes"),
                     Number("rotation").Array(4, 4).AtLeast(-1).AtMost(1),
                     Number("scale").Array(3, 3), Number("translation").Array(3, 3),
                     Number("weights").Array(), String("name")},
      .extensions = {{"EXT_mesh_gpu_instancing", &schemas::Instancing()},
                     {"KHR_lights_punctual", &schemas::NodeLight()},
                     {"KHR_node_visibility", &schemas::Visibility()}},
      .extras = &schemas::NodeExtras()};
  return schema;
}

const ObjectSchema& Sampler() {
  static const ObjectSchema schema{
      .properties = {Code("magFilter", {9728, 9729}),
                     Code("minFilter", {9728, 9729, 9984, 9985, 9986, 9987}),
                     Code("wrapS", {33071, 33648, 10497}), Code("wrapT", {33071, 33648, 10497}),
                     String("name")}};
  return schema;
}

const ObjectSchema& Scene() {
  static const ObjectSchema schema{
      .properties = {Reference("nodes", "nodes").Array().Unique(), String("name")}};
  return schema;
}

const ObjectSchema& Skin() {
  static const ObjectSchema schema{
      .properties = {Reference("inverseBindMatrices", "accessors"), Reference("skeleton", "nodes"),
                     Reference("joints", "nodes").Array().Unique().Required(), String("name")}};
  return schema;
}

const ObjectSchema& Texture() {
  static const ObjectSchema schema{.properties = {Reference("sampler", "samplers"),
                                                  Reference("source", "images"), String("name")}};
  return schema;
}

}  // namespace

const ObjectSchema& RootSchema() {
  static const ObjectSchema schema{
      .properties = {String("extensionsUsed").Array().Unique(),
                     String("extensionsRequired").Array().Unique(),
                     Object("accessors", Accessor()).Array(),
                     Object("animations", Animation()).Array(), Object("asset", Asset()).Required(),
                     Object("buffers", Buffer()).Array(),
                     Object("bufferViews", BufferView()).Array(),
                     Object("cameras", Camera()).Array(), Object("images", Image()).Array(),
                     Object("materials", Material()).Array(), Object("meshes", Mesh()).Array(),
                     Object("nodes", Node()).Array(), Object("samplers", Sampler()).Array(),
                     Reference("scene", "scenes"), Object("scenes", Scene()).Array(),
                     Object("skins", Skin()).Array(), Object("textures", Texture()).Array()},
      .extensions = {{"KHR_lights_punctual", &schemas::Lights()}}};
  return schema;
}

Property Integer(std::string_view name) {
  return {.name = name, .kind = Property::Kind::kInteger};
}
Property Number(std::string_view name) {
  return {.name = name, .kind = Property::Kind::kNumber};
}
Property Boolean(std::string_view name) {
  return {.name = name, .kind = Property::Kind::kBoolean};
}
Property String(std::string_view name) {
  return {.name = name, .kind = Property::Kind::kString};
}
Property Word(std::string_view name, std::vector<std::string_view> allowed) {
  Property property = String(name);
  property.words = std::move(allowed);
  return property;
}
Property Code(std::string_view name, std::vector<int64_t> allowed) {
  Property property = Integer(name);
  property.codes = std::move(allowed);
  return property;
}
Property Reference(std::string_view name, std::string_view collection) {
  Property property = Integer(name);
  property.kind = Property::Kind::kReference;
  property.collection = collection;
  return property;
}
Property Object(std::string_view name, const ObjectSchema& schema) {
  Property property = String(name);
  property.kind = Property::Kind::kObject;
  property.object = &schema;
  return property;
}

}  // namespace fenestra::gltf
