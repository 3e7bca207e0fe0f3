#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/metric_samples.h"
#include "experiments/study/study.h"

namespace fenestra {

/// The states of prior knowledge that the table compares. kNominal: stereo detectors know their
/// nominal calibration, RGB-D detectors do not know how far the window frame stands behind the
/// wall's face; kGeometry: the true calibration, and that distance.
enum class Known { kNominal, kGeometry, kSize, kGeometryAndSize };
inline constexpr std::array<Known, 4> kAllKnown = {Known::kNominal, Known::kGeometry, Known::kSize,
                                                   Known::kGeometryAndSize};

/// The bounds of one cell of a study.
struct CellBounds {
  std::string part;
  SensorKind sensor;
  FactorValues levels;
  int in_view = 0;  ///< Trials with the target wholly in view: these count.
  /// √ of the mean variance over these trials, by Known; nullopt if one of them has no bound.
  std::array<std::optional<ErrorBounds>, kAllKnown.size()> bounds{};
};

/// From the first `trials` trials of the cell, none of which a detector sees.
CellBounds BoundsOfCell(const Study& study, const Cell& cell, int trials);

/// A table for the terminal: bounds in depth and in three dimensions [mm].
std::string BoundTable(const std::vector<CellBounds>& cells);

}  // namespace fenestra
