#include "scenes/gltf/fault_list.h"

#include <fmt/format.h>

namespace fenestra::gltf {
namespace {

// A file can be wrong in a million places; nobody reads more than this.
constexpr size_t kMostFaults = 50;

}  // namespace

void FaultList::Add(std::string_view pointer, std::string_view message) {
  if (faults_.size() == kMostFaults) {
    ++left_out_;
    return;
  }
  faults_.push_back(
      {file_.string(), 0, 0,
       pointer.empty() ? std::string(message) : fmt::format("{}: {}", pointer, message)});
}

void FaultList::ThrowIfAny() const {
  if (faults_.empty()) return;
  std::vector<InputFault> faults = faults_;
  if (left_out_ > 0) {
    faults.push_back({file_.string(), 0, 0, fmt::format("and {} more faults", left_out_)});
  }
  throw InputError(std::move(faults));
}

std::string PointerToken(std::string_view name) {
  std::string token;
  for (const char c : name) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

}  // namespace fenestra::gltf
