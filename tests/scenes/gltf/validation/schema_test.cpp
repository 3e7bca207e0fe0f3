#include "scenes/gltf/validation/schema.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

// Laws that the tables keep, whatever stands in them.

namespace fenestra::gltf {
namespace {

using Kind = Property::Kind;

// Every object that can be reached from the root, once.
std::set<const ObjectSchema*> AllObjects() {
  std::set<const ObjectSchema*> seen;
  const std::function<void(const ObjectSchema*)> visit = [&](const ObjectSchema* schema) {
    if (schema == nullptr || !seen.insert(schema).second) return;
    for (const Property& property : schema->properties) visit(property.object);
    for (const auto& [name, extension] : schema->extensions) visit(extension);
    visit(schema->extras);
  };
  visit(&RootSchema());
  return seen;
}

const Property* PropertyOf(const ObjectSchema& schema, std::string_view name) {
  for (const Property& property : schema.properties) {
    if (property.name == name) return &property;
  }
  return nullptr;
}

TEST(Schema, NoMemberStandsTwice) {
  for (const ObjectSchema* schema : AllObjects()) {
    std::set<std::string_view> names;
    for (const Property& property : schema->properties) {
      EXPECT_TRUE(names.insert(property.name).second) << property.name;
      EXPECT_FALSE(property.name.empty());
    }
  }
}

TEST(Schema, EveryReferencePointsIntoAnArrayOfTheRoot) {
  const auto is_collection = [](std::string_view name) {
    if (name == "lights") return true;  // In an extension of the root.
    const Property* property = PropertyOf(RootSchema(), name);
    return property != nullptr && property->is_array && property->kind == Kind::kObject;
  };
  size_t references = 0;
  for (const ObjectSchema* schema : AllObjects()) {
    for (const Property& property : schema->properties) {
      if (property.kind != Kind::kReference) continue;
      ++references;
      EXPECT_TRUE(is_collection(property.collection)) << property.name;
    }
    if (!schema->members_refer_to.empty()) {
      EXPECT_TRUE(is_collection(schema->members_refer_to)) << schema->members_refer_to;
    }
  }
  EXPECT_GT(references, 20u);
}

TEST(Schema, EachKindHasWhatItNeedsAndNothingElse) {
  for (const ObjectSchema* schema : AllObjects()) {
    for (const Property& property : schema->properties) {
      EXPECT_EQ(property.object != nullptr, property.kind == Kind::kObject) << property.name;
      EXPECT_EQ(!property.collection.empty(), property.kind == Kind::kReference) << property.name;
      EXPECT_TRUE(property.words.empty() || property.kind == Kind::kString) << property.name;
      EXPECT_TRUE(property.codes.empty() || property.kind == Kind::kInteger) << property.name;
    }
  }
}

TEST(Schema, RangesAreNotEmpty) {
  for (const ObjectSchema* schema : AllObjects()) {
    for (const Property& property : schema->properties) {
      EXPECT_LT(property.low, property.high) << property.name;
      EXPECT_LE(property.min_items, property.max_items) << property.name;
      EXPECT_GE(property.min_items, 1u) << property.name << ": glTF forbids empty arrays";
    }
  }
}

// Section 3 of the specification: what every document must have.
TEST(Schema, WhatTheSpecificationRequiresIsRequired) {
  const auto requires_member = [](const char* collection, const char* member) {
    const Property* property = PropertyOf(RootSchema(), collection);
    const Property* required = PropertyOf(*property->object, member);
    return required != nullptr && required->is_required;
  };
  EXPECT_TRUE(PropertyOf(RootSchema(), "asset")->is_required);
  EXPECT_TRUE(requires_member("asset", "version"));
  EXPECT_TRUE(requires_member("accessors", "componentType"));
  EXPECT_TRUE(requires_member("accessors", "count"));
  EXPECT_TRUE(requires_member("accessors", "type"));
  EXPECT_TRUE(requires_member("buffers", "byteLength"));
  EXPECT_TRUE(requires_member("bufferViews", "buffer"));
  EXPECT_TRUE(requires_member("meshes", "primitives"));
  EXPECT_TRUE(requires_member("skins", "joints"));
  EXPECT_FALSE(requires_member("accessors", "bufferView"));
}

TEST(Schema, OursAloneIsClosed) {
  size_t closed = 0;
  for (const ObjectSchema* schema : AllObjects()) {
    closed += schema->is_closed;
    EXPECT_TRUE(schema->extras == nullptr || schema->extras->is_closed);
  }
  EXPECT_GE(closed, 5u);
  EXPECT_FALSE(RootSchema().is_closed);
}

TEST(Schema, PropertiesAreChangedOneByOne) {
  const Property count = Integer("count").AtLeast(1).AtMost(9).Array(2, 4).Unique().Required();
  EXPECT_EQ(count.name, "count");
  EXPECT_EQ(count.low, 1.0);
  EXPECT_EQ(count.high, 9.0);
  EXPECT_TRUE(count.is_array && count.has_unique_items && count.is_required);
  EXPECT_EQ(count.max_items, 4u);
  EXPECT_FALSE(count.low_is_excluded);
  EXPECT_TRUE(Number("yfov").Above(0).low_is_excluded);
  EXPECT_FALSE(Integer("count").is_required);
}

}  // namespace
}  // namespace fenestra::gltf
