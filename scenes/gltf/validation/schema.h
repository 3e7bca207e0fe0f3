#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace fenestra::gltf {

struct ObjectSchema;

/// The allowed values of a member of a JSON object: one row of the glTF 2.0 schema. If `is_array`
/// is set, the limits on values hold for each element.
struct Property {
  enum class Kind { kInteger, kNumber, kBoolean, kString, kReference, kObject };

  std::string_view name = {};
  Kind kind = Kind::kString;
  bool is_array = false;
  bool is_required = false;
  bool has_unique_items = false;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_is_excluded = false;
  size_t min_items = 1;  ///< glTF forbids empty arrays.
  size_t max_items = std::numeric_limits<size_t>::max();
  std::vector<std::string_view> words = {};  ///< The allowed strings; empty: all.
  std::vector<int64_t> codes = {};           ///< The allowed integers; empty: all.
  std::string_view collection = {};          ///< kReference: the root array that it points into.
  const ObjectSchema* object = nullptr;
  std::string_view needs = {};  ///< Another member without which this one must not be.

  Property Needs(std::string_view other) const {
    return With([&](Property& p) { p.needs = other; });
  }
  Property Required() const {
    return With([](Property& p) { p.is_required = true; });
  }
  Property Unique() const {
    return With([](Property& p) { p.has_unique_items = true; });
  }
  Property Array(size_t least = 1, size_t most = std::numeric_limits<size_t>::max()) const {
    return With([&](Property& p) {
      p.is_array = true;
      p.min_items = least;
      p.max_items = most;
    });
  }
  Property AtLeast(double limit) const {
    return With([&](Property& p) { p.low = limit; });
  }
  Property AtMost(double limit) const {
    return With([&](Property& p) { p.high = limit; });
  }
  Property Above(double limit) const {
    return With([&](Property& p) {
      p.low = limit;
      p.low_is_excluded = true;
    });
  }

 private:
  template <typename Change>
  Property With(const Change& change) const {
    Property changed = *this;
    change(changed);
    return changed;
  }
};

/// An object of the schema.
struct ObjectSchema {
  std::vector<Property> properties = {};
  /// Extensions that are allowed here. A supported extension elsewhere is a fault.
  std::vector<std::pair<std::string_view, const ObjectSchema*>> extensions = {};
  /// Allowed members of `extras.fenestra`, if any.
  const ObjectSchema* extras = nullptr;
  /// Every member is a reference into this root array (a primitive's attributes).
  std::string_view members_refer_to = {};
  /// No other members are allowed: for Fenestra's own extras, where a misspelt one would be lost.
  bool is_closed = false;
};

/// The document's root.
const ObjectSchema& RootSchema();

/// Schemas of the objects under an extension's name or in `extras.fenestra`.
namespace schemas {
const ObjectSchema& Empty();
const ObjectSchema& Attributes();
const ObjectSchema& Instancing();
const ObjectSchema& TextureTransform();
const ObjectSchema& Transmission();
const ObjectSchema& IndexOfRefraction();
const ObjectSchema& EmissiveStrength();
const ObjectSchema& Visibility();
const ObjectSchema& Lights();
const ObjectSchema& NodeLight();
const ObjectSchema& NodeExtras();
const ObjectSchema& MeshExtras();
const ObjectSchema& MaterialExtras();
const ObjectSchema& CameraExtras();
const ObjectSchema& LightExtras();
}  // namespace schemas

Property Integer(std::string_view name);
Property Number(std::string_view name);
Property Boolean(std::string_view name);
Property String(std::string_view name);
Property Word(std::string_view name, std::vector<std::string_view> allowed);
Property Code(std::string_view name, std::vector<int64_t> allowed);
Property Reference(std::string_view name, std::string_view collection);
Property Object(std::string_view name, const ObjectSchema& schema);

}  // namespace fenestra::gltf
