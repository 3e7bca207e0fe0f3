#include "experiments/analysis/pooled_metrics.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/faults.h"

namespace fenestra {
namespace {

std::vector<std::string> KnownNames(const Study& study) {
  std::vector<std::string> names{"part", "sensor", "detector"};
  for (const StudyPart& part : study.parts) {
    for (const Factor& factor : part.factors) {
      if (std::find(names.begin(), names.end(), factor.name) == names.end()) {
        names.push_back(factor.name);
      }
    }
  }
  return names;
}

void CheckNames(const Study& study, const std::vector<std::string>& by) {
  const std::vector<std::string> known = KnownNames(study);
  Faults faults("--by");
  for (const std::string& name : by) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    faults.Add(fmt::format("'{}' is no factor of '{}', detector, part or sensor.{}", name,
                           study.name, DidYouMean(name, known)));
  }
  faults.ThrowIfAny();
}

}  // namespace

PooledMetrics::PooledMetrics(const Study& study, std::span<const Cell> cells, Pooling pooling)
    : pooling_(std::move(pooling)), selection_(study, cells), context_(study, cells) {
  CheckNames(study, pooling_.by);
}

void PooledMetrics::Add(const TrialRecord& row) {
  if (!selection_.Matches(row, pooling_.where)) return;
  std::vector<std::optional<ParameterValue>> key;
  for (const std::string& name : pooling_.by) key.push_back(selection_.ValueOf(row, name));
  Group& group = groups_[std::move(key)];
  group.tally.Add(context_.Of(row));
  group.confidence = std::max(group.confidence, context_.Confidence(row.cell));
}

std::vector<PooledGroup> PooledMetrics::Groups() const {
  std::vector<PooledGroup> groups;
  for (const auto& [values, group] : groups_) {
    groups.push_back({.values = values,
                      .metrics = EstimatesOf(group.tally, group.confidence, pooling_.metrics),
                      .confidence = group.confidence});
  }
  return groups;
}

}  // namespace fenestra
