#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/pooled_metrics.h"

namespace fenestra {

/// One line for each group and metric: the values that made the group, the metric's name, its
/// value, of a share how many rows have it, how many rows count, its interval, how the interval was
/// made and of how many independent witnesses. The columns from "figure" on are those of
/// intervals.csv.
std::string PooledCsv(const std::vector<std::string>& by, std::span<const PooledGroup> groups);

/// One line for each group with the metrics named, each with its interval and what it is of.
std::string PooledTable(const std::vector<std::string>& by, std::span<const PooledGroup> groups,
                        const std::vector<std::string>& metrics);

}  // namespace fenestra
