#pragma once

#include <stdexcept>
#include <string>

namespace fenestra {

/// Thrown by a detector that can give neither an estimate nor a Miss and knows a name for why. It
/// costs the detector this observation.
class DetectorFailure : public std::runtime_error {
 public:
  /// `kind` is a stable identifier in snake_case, such as "timeout"; `detail` is for people.
  DetectorFailure(std::string kind, const std::string& detail)
      : std::runtime_error(detail), kind_(std::move(kind)) {}

  const std::string& kind() const { return kind_; }

 private:
  std::string kind_;
};

}  // namespace fenestra
