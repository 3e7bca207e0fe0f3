#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/input_error.h"

namespace fenestra {

/// What is asked of one input. All that it does not meet is said at once:
///
///     Demands demand("camera");
///     demand(p.fx_px > 0.0, "the focal length must be positive");
///     demand.ThrowUnlessMet();
class Demands {
 public:
  /// `source`: what the input is called, see InputFault.
  explicit Demands(std::string source) : source_(std::move(source)) {}

  void operator()(bool holds, std::string message) {
    if (!holds) faults_.push_back({source_, 0, 0, std::move(message)});
  }
  /// Faults that were found elsewhere.
  void Add(const std::vector<std::string>& messages) {
    for (const std::string& message : messages) (*this)(false, message);
  }

  bool met() const { return faults_.empty(); }
  /// Throws InputError.
  void ThrowUnlessMet() const {
    if (!met()) throw InputError(faults_);
  }

 private:
  std::string source_;
  std::vector<InputFault> faults_;
};

}  // namespace fenestra
