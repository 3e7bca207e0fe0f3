#include "scenes/gltf/validation/structure_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/io/faults.h"
#include "scenes/gltf/file/document.h"
#include "scenes/gltf/validation/extensions.h"
#include "scenes/gltf/validation/schema.h"

namespace fenestra::gltf {
namespace {

using nlohmann::json;
using Kind = Property::Kind;

class SchemaCheck {
 public:
  SchemaCheck(const json& root, Faults& faults)
      : root_(root), declared_(DeclaredExtensions(root)), faults_(faults) {}

  void Object(const json& value, const ObjectSchema& schema, const std::string& at);

 private:
  void Member(const json& object, const Property& property, const std::string& at);
  void Array(const json& value, const Property& property, const std::string& at);
  void Value(const json& value, const Property& property, const std::string& at);
  void WholeNumber(const json& value, const Property& property, const std::string& at);
  void Range(double value, const Property& property, const std::string& at);
  void Text(const json& value, const Property& property, const std::string& at);
  void Reference(const json& value, std::string_view collection, const std::string& at);
  void Extensions(const json& object, const ObjectSchema& schema, const std::string& at);
  void Extras(const json& object, const ObjectSchema& schema, const std::string& at);
  void UnknownMembers(const json& object, const ObjectSchema& schema, const std::string& at);
  size_t SizeOf(std::string_view collection) const;

  const json& root_;
  const std::set<std::string> declared_;
  Faults& faults_;
};

void SchemaCheck::Object(const json& value, const ObjectSchema& schema, const std::string& at) {
  if (!value.is_object()) {
    faults_.Add(at, fmt::format("must be an object, not {}", value.type_name()));
    return;
  }
  for (const Property& property : schema.properties) Member(value, property, at);
  if (schema.is_closed) UnknownMembers(value, schema, at);
  if (!schema.members_refer_to.empty()) {
    if (value.empty()) faults_.Add(at, "must not be empty");
    for (const auto& [name, index] : value.items()) {
      Reference(index, schema.members_refer_to, at + MemberPointer(name));
    }
    return;
  }
  Extensions(value, schema, at);
  if (schema.extras != nullptr) Extras(value, schema, at);
}

void SchemaCheck::Member(const json& object, const Property& property, const std::string& at) {
  const auto found = object.find(property.name);
  if (found == object.end()) {
    if (property.is_required) faults_.Add(at, fmt::format("'{}' is missing", property.name));
    return;
  }
  const std::string pointer = fmt::format("{}/{}", at, property.name);
  if (!property.needs.empty() && !object.contains(property.needs)) {
    faults_.Add(pointer, fmt::format("needs '{}', which is missing", property.needs));
  }
  if (property.is_array) {
    Array(*found, property, pointer);
  } else {
    Value(*found, property, pointer);
  }
}

void SchemaCheck::Array(const json& value, const Property& property, const std::string& at) {
  if (!value.is_array()) {
    faults_.Add(at, fmt::format("must be an array, not {}", value.type_name()));
    return;
  }
  if (value.size() < property.min_items || value.size() > property.max_items) {
    const bool fixed = property.min_items == property.max_items;
    faults_.Add(
        at, value.empty() ? std::string("must not be empty")
            : fixed ? fmt::format("must have {} elements, not {}", property.min_items, value.size())
                    : fmt::format("must have at most {} elements, not {}", property.max_items,
                                  value.size()));
    return;
  }
  std::set<json> seen;
  for (size_t i = 0; i < value.size(); ++i) {
    const std::string pointer = fmt::format("{}/{}", at, i);
    Value(value[i], property, pointer);
    if (property.has_unique_items && !seen.insert(value[i]).second) {
      faults_.Add(pointer, fmt::format("{} is there twice", value[i].dump()));
    }
  }
}

void SchemaCheck::Value(const json& value, const Property& property, const std::string& at) {
  switch (property.kind) {
    case Kind::kInteger:
      return WholeNumber(value, property, at);
    case Kind::kNumber:
      if (!value.is_number()) return faults_.Add(at, "must be a number");
      return Range(value.get<double>(), property, at);
    case Kind::kBoolean:
      if (!value.is_boolean()) faults_.Add(at, "must be true or false");
      return;
    case Kind::kString:
      return Text(value, property, at);
    case Kind::kReference:
      return Reference(value, property.collection, at);
    case Kind::kObject:
      return Object(value, *property.object, at);
  }
}

void SchemaCheck::WholeNumber(const json& value, const Property& property, const std::string& at) {
  if (!value.is_number_integer()) return faults_.Add(at, "must be an integer");
  Range(value.get<double>(), property, at);
  if (property.codes.empty()) return;
  if (std::ranges::find(property.codes, value.get<int64_t>()) == property.codes.end()) {
    faults_.Add(at, fmt::format("must be one of {}, not {}", fmt::join(property.codes, ", "),
                                value.dump()));
  }
}

void SchemaCheck::Range(double value, const Property& property, const std::string& at) {
  if (property.low_is_excluded ? !(value > property.low) : !(value >= property.low)) {
    faults_.Add(
        at, fmt::format("must be {} {}, not {}", property.low_is_excluded ? "above" : "at least",
                        property.low, value));
  } else if (!(value <= property.high)) {
    faults_.Add(at, fmt::format("must be at most {}, not {}", property.high, value));
  }
}

void SchemaCheck::Text(const json& value, const Property& property, const std::string& at) {
  if (!value.is_string()) return faults_.Add(at, "must be a string");
  const auto& word = value.get_ref<const std::string&>();
  if (property.words.empty() || std::ranges::find(property.words, word) != property.words.end()) {
    return;
  }
  faults_.Add(at,
              fmt::format("must be one of {}, not '{}'", fmt::join(property.words, ", "), word));
}

void SchemaCheck::Reference(const json& value, std::string_view collection, const std::string& at) {
  if (!value.is_number_integer()) return faults_.Add(at, "must be an integer");
  const size_t size = SizeOf(collection);
  // As double, since a negative or huge integer may stand there.
  const auto index = value.get<double>();
  if (index >= 0 && index < static_cast<double>(size)) return;
  faults_.Add(at, fmt::format("{} does not exist; there {} {} in '{}'", value.dump(),
                              size == 1 ? "is" : "are", size, collection));
}

size_t SchemaCheck::SizeOf(std::string_view collection) const {
  const json* owner = &root_;
  if (collection == "lights") {
    for (const char* name : {"extensions", "KHR_lights_punctual"}) {
      if (!owner->is_object() || !owner->contains(name)) return 0;
      owner = &owner->at(name);
    }
  }
  if (!owner->is_object()) return 0;
  const auto found = owner->find(collection);
  return found != owner->end() && found->is_array() ? found->size() : 0;
}

void SchemaCheck::Extensions(const json& object, const ObjectSchema& schema,
                             const std::string& at) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return;
  const std::string pointer = at + "/extensions";
  if (!extensions->is_object()) return faults_.Add(pointer, "must be an object");
  for (const auto& [name, value] : extensions->items()) {
    const std::string here = pointer + MemberPointer(name);
    if (!declared_.contains(name)) faults_.Add(here, "is not in 'extensionsUsed'");
    const auto allowed =
        std::ranges::find(schema.extensions, name, [](const auto& e) { return e.first; });
    if (allowed != schema.extensions.end()) {
      Object(value, *allowed->second, here);
    } else if (!value.is_object()) {
      faults_.Add(here, "must be an object");
    } else if (IsSupported(name)) {
      faults_.Add(here, "does not belong here");
    }
  }
}

void SchemaCheck::Extras(const json& object, const ObjectSchema& schema, const std::string& at) {
  const auto extras = object.find("extras");
  if (extras == object.end() || !extras->is_object()) return;
  const auto ours = extras->find("fenestra");
  if (ours != extras->end()) Object(*ours, *schema.extras, at + "/extras/fenestra");
}

void SchemaCheck::UnknownMembers(const json& object, const ObjectSchema& schema,
                                 const std::string& at) {
  std::vector<std::string> known;
  for (const Property& property : schema.properties) known.emplace_back(property.name);
  for (const auto& [name, value] : object.items()) {
    if (std::ranges::find(known, name) != known.end()) continue;
    faults_.Add(
        at + MemberPointer(name),
        fmt::format("is not known here; {} {}.{}", known.size() == 1 ? "known is" : "known are",
                    fmt::join(known, ", "), DidYouMean(name, known)));
  }
}

}  // namespace

void CheckSchema(const json& root, Faults& faults) {
  SchemaCheck(root, faults).Object(root, RootSchema(), "");
}

}  // namespace fenestra::gltf
