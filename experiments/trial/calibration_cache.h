#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/geometry/calibration.h"
#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// A calibration and the covariance that it states of itself; see StereoCalibrationResult.
struct CalibrationWithCovariance {
  StereoCalibration calibration;
  PairMatrix covariance;

  bool operator==(const CalibrationWithCovariance&) const = default;
};

/// Calibrations that were computed before, kept in files: the cells of a study share their rigs,
/// and a study that is resumed, or run again with another detector, meets the same ones. The name
/// of a file is the SHA-256 of all that its calibration depends on, the program's own build among
/// it; its last line is that of its content, so that damage is noticed and the calibration computed
/// anew. Files appear by rename. Thread-safe, and safe between processes.
class CalibrationCache {
 public:
  /// No cache: everything is computed.
  CalibrationCache() = default;
  explicit CalibrationCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// In $FENESTRA_CACHE, $XDG_CACHE_HOME/fenestra or ~/.cache/fenestra. None if there is no such
  /// place or the program's build cannot be told from others. A variable that is empty or not an
  /// absolute path is passed over.
  static CalibrationCache OfUser();

  /// The calibration that belongs to `content`; `compute` makes it where it is not known. A folder
  /// that cannot be written costs time, not the result.
  CalibrationWithCovariance Get(const std::string& content,
                                const std::function<CalibrationWithCovariance()>& compute) const;

 private:
  std::optional<std::filesystem::path> folder_;
};

}  // namespace fenestra
