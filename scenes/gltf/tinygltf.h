#pragma once

// tinygltf is compiled from its header rather than linked as Debian's library, so that it comes
// without file access and without image decoders: neither can then be led astray by a file. The
// macros change its classes, so every inclusion goes through here.
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>

#include <initializer_list>
#include <string>

namespace fenestra::gltf {

/// The member at the end of a path of names, or nullptr where there is none.
inline const tinygltf::Value* Find(const tinygltf::Value& value,
                                   std::initializer_list<const char*> path) {
  const tinygltf::Value* at = &value;
  for (const char* name : path) {
    if (!at->Has(name)) return nullptr;
    at = &at->Get(name);
  }
  return at;
}

inline double NumberOr(const tinygltf::Value* value, double otherwise) {
  return value != nullptr && value->IsNumber() ? value->GetNumberAsDouble() : otherwise;
}

/// An extension's object, or nullptr where it is not there.
inline const tinygltf::Value* Extension(const tinygltf::ExtensionMap& extensions,
                                        const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

/// A number in an extension, or the default of its specification.
inline double ExtensionNumberOr(const tinygltf::ExtensionMap& extensions, const std::string& name,
                                const char* member, double otherwise) {
  const tinygltf::Value* extension = Extension(extensions, name);
  return extension == nullptr ? otherwise : NumberOr(Find(*extension, {member}), otherwise);
}

}  // namespace fenestra::gltf
