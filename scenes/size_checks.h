#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/input_error.h"

namespace fenestra {

/// Collects the faults of a scene's options, so that all of them are reported at once.
class SizeChecks {
 public:
  explicit SizeChecks(std::string source) : source_(std::move(source)) {}

  void Positive(const char* name, double value_m) {
    Demand(std::isfinite(value_m) && value_m > 0.0,
           fmt::format("{} must be positive, not {}", name, value_m));
  }
  void Reflectance(const char* name, double value) {
    Demand(value >= 0.0 && value <= 1.0, fmt::format("{} must be in [0, 1], not {}", name, value));
  }
  void Demand(bool holds, std::string message) {
    if (!holds) faults_.push_back({source_, 0, 0, std::move(message)});
  }
  void ThrowIfFaulty() const {
    if (!faults_.empty()) throw InputError(faults_);
  }

 private:
  std::string source_;
  std::vector<InputFault> faults_;
};

}  // namespace fenestra
