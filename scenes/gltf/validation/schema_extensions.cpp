#include "scenes/gltf/validation/schema.h"

namespace fenestra::gltf::schemas {
namespace {

// Keeps sums and products of sizes finite in single precision.
constexpr double kLargest = 1e9;

const ObjectSchema& Spot() {
  static const ObjectSchema schema{
      .properties = {Number("innerConeAngle").AtLeast(0).AtMost(1.5707963267948966),
                     Number("outerConeAngle").Above(0).AtMost(1.5707963267948966)}};
  return schema;
}

const ObjectSchema& Light() {
  static const ObjectSchema schema{
      .properties = {Number("color").Array(3, 3).AtLeast(0).AtMost(1),
                     Number("intensity").AtLeast(0), Number("range").Above(0),
                     Object("spot", Spot()),
                     Word("type", {"directional", "point", "spot"}).Required(), String("name")},
      .extras = &LightExtras()};
  return schema;
}

const ObjectSchema& WindowSize() {
  static const ObjectSchema schema{
      .properties = {Number("width_m").Above(0).AtMost(kLargest).Required(),
                     Number("height_m").Above(0).AtMost(kLargest).Required()},
      .is_closed = true};
  return schema;
}

}  // namespace

const ObjectSchema& Empty() {
  static const ObjectSchema schema;
  return schema;
}

const ObjectSchema& Attributes() {
  static const ObjectSchema schema{.members_refer_to = "accessors"};
  return schema;
}

const ObjectSchema& Instancing() {
  static const ObjectSchema schema{.properties = {Object("attributes", Attributes()).Required()}};
  return schema;
}

const ObjectSchema& TextureTransform() {
  static const ObjectSchema schema{.properties = {Number("offset").Array(2, 2), Number("rotation"),
                                                  Number("scale").Array(2, 2),
                                                  Integer("texCoord").AtLeast(0).AtMost(15)}};
  return schema;
}

const ObjectSchema& Transmission() {
  static const ObjectSchema schema{
      .properties = {Number("transmissionFactor").AtLeast(0).AtMost(1)}};
  return schema;
}

const ObjectSchema& IndexOfRefraction() {
  static const ObjectSchema schema{.properties = {Number("ior").AtLeast(0).AtMost(kLargest)}};
  return schema;
}

const ObjectSchema& EmissiveStrength() {
  static const ObjectSchema schema{.properties = {Number("emissiveStrength").AtLeast(0)}};
  return schema;
}

const ObjectSchema& Visibility() {
  static const ObjectSchema schema{.properties = {Boolean("visible")}};
  return schema;
}

const ObjectSchema& Lights() {
  static const ObjectSchema schema{.properties = {Object("lights", Light()).Array().Required()}};
  return schema;
}

const ObjectSchema& NodeLight() {
  static const ObjectSchema schema{.properties = {Reference("light", "lights").Required()}};
  return schema;
}

const ObjectSchema& NodeExtras() {
  static const ObjectSchema schema{
      .properties = {Object("target_window", WindowSize()), Object("other_window", WindowSize())},
      .is_closed = true};
  return schema;
}

const ObjectSchema& MeshExtras() {
  static const ObjectSchema schema{.properties = {Boolean("closed")}, .is_closed = true};
  return schema;
}

const ObjectSchema& MaterialExtras() {
  static const ObjectSchema schema{
      .properties = {Number("reflectance_830nm").AtLeast(0).AtMost(1),
                     Number("emission_830nm").AtLeast(0).AtMost(kLargest)},
      .is_closed = true};
  return schema;
}

const ObjectSchema& CameraExtras() {
  static const ObjectSchema schema{
      .properties = {Integer("width_px").AtLeast(1).AtMost(16384).Required(),
                     Integer("height_px").AtLeast(1).AtMost(16384).Required(),
                     Number("fx_px").Above(0).AtMost(kLargest).Required(),
                     Number("fy_px").Above(0).AtMost(kLargest).Required(),
                     Number("cx_px").AtLeast(-kLargest).AtMost(kLargest).Required(),
                     Number("cy_px").AtLeast(-kLargest).AtMost(kLargest).Required(),
                     Number("distortion").Array(5, 5).AtLeast(-kLargest).AtMost(kLargest)},
      .is_closed = true};
  return schema;
}

const ObjectSchema& LightExtras() {
  static const ObjectSchema schema{
      .properties = {Number("irradiance_830_per_lux").AtLeast(0).AtMost(kLargest)},
      .is_closed = true};
  return schema;
}

}  // namespace fenestra::gltf::schemas
