#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/input_error.h"

namespace fenestra::gltf {

/// Collects the faults of one file, each with its place in the document as a JSON pointer
/// (RFC 6901), so that all of them are reported at once.
class FaultList {
 public:
  explicit FaultList(std::filesystem::path file) : file_(std::move(file)) {}

  void Add(std::string_view pointer, std::string_view message);
  bool empty() const { return faults_.empty(); }
  const std::filesystem::path& file() const { return file_; }
  void ThrowIfAny() const;

 private:
  std::filesystem::path file_;
  std::vector<InputFault> faults_;
  size_t left_out_ = 0;
};

/// A member's name as it stands in a JSON pointer.
std::string PointerToken(std::string_view name);

}  // namespace fenestra::gltf
