#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/input_error.h"
#include "scenes/paint.h"

namespace fenestra {

/// Collects the faults of a scene's options, so that all of them are reported at once.
class SizeChecks {
 public:
  explicit SizeChecks(std::string source) : source_(std::move(source)) {}

  void Positive(const char* name, double value_m) {
    Demand(std::isfinite(value_m) && value_m > 0.0,
           fmt::format("{} must be positive, not {}", name, value_m));
  }
  void NotNegative(const char* name, double value) {
    Demand(std::isfinite(value) && value >= 0.0,
           fmt::format("{} must be 0 or more, not {}", name, value));
  }
  void Within(const char* name, double value, double min, double max) {
    Demand(value >= min && value <= max,
           fmt::format("{} must be in [{}, {}], not {}", name, min, max, value));
  }
  void Reflectance(const char* name, double value) {
    Demand(value >= 0.0 && value <= 1.0, fmt::format("{} must be in [0, 1], not {}", name, value));
  }
  /// `name` and "_reflectance" make the name of the paint's reflectance.
  void Painted(const std::string& name, const Paint& paint) {
    Reflectance((name + "_reflectance").c_str(), paint.reflectance);
    Reflectance((name + "_reflectance_830nm").c_str(), paint.reflectance_830nm);
    const double most = MostReflectance(paint.hue);
    Demand(!(paint.reflectance > most) || paint.reflectance > 1.0,
           fmt::format("{}_reflectance can be up to {:.3f} in {}, not {}", name, most,
                       HueNames().at(static_cast<size_t>(paint.hue)), paint.reflectance));
  }
  void Demand(bool holds, std::string message) {
    if (!holds) faults_.push_back({source_, 0, 0, std::move(message)});
  }
  bool faultless() const { return faults_.empty(); }
  void ThrowIfFaulty() const {
    if (!faults_.empty()) throw InputError(faults_);
  }

 private:
  std::string source_;
  std::vector<InputFault> faults_;
};

}  // namespace fenestra
