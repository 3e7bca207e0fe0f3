#pragma once

#include <optional>

#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// What an estimate knows of a frame besides its pictures.
struct Knowledge {
  /// Standard deviation of width and height around what is expected [m]; nullopt: not expected.
  std::optional<double> size_sigma_m = {};
  /// How far the calibration that it is told may be from the truth; nullopt: it is the truth.
  std::optional<PairMatrix> calibration = {};
};

}  // namespace fenestra
