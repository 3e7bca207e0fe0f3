#pragma once

#include <string>
#include <vector>

#include "core/io/yaml_reader.h"
#include "experiments/check/limit.h"

namespace fenestra {

/// A file of limits:
///
///     study: paper              # a study's name or file, run where no results are given
///     false_alarm: 0.05         # P(any limit is called violated, though all hold); the default
///     confidence: 0.95          # of limits that name none; the default
///     limits:
///       - p95(centroid_error_mm) <= 15 where detector = edge-stereo and distance_m <= 3
///       - rate(hit) >= 0.98 in each cell where detector = edge-stereo
struct LimitFile {
  std::string study;  ///< Empty if it names none.
  double false_alarm = 0.05;
  std::vector<Limit> limits;
};

/// Throws InputError with all faults and their positions.
LimitFile ReadLimitFile(YamlReader reader);

}  // namespace fenestra
