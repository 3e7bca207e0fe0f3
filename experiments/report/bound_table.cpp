#include "experiments/report/bound_table.h"

#include <algorithm>
#include <cmath>

#include "experiments/output/number_format.h"
#include "experiments/output/text_table.h"
#include "experiments/trial/cell_runner.h"

namespace fenestra {
namespace {

// As good as exact, but finite.
constexpr double kKnownSize_m = 1e-6;
// A window may be flush with its wall or deep in its reveal.
constexpr double kUnknownWall_m = 0.1;

PriorKnowledge PriorKnowledgeFor(Known known, const TrialInformation& information) {
  PriorKnowledge knowledge;
  if (known == Known::kNominal || known == Known::kSize) {
    knowledge.calibration = information.calibration;
    if (information.sensor == SensorKind::kRgbd) knowledge.wall_sigma_m = kUnknownWall_m;
  }
  if (known == Known::kSize || known == Known::kGeometryAndSize) {
    knowledge.size_sigma_m = kKnownSize_m;
  }
  return knowledge;
}

std::optional<ErrorBounds> RootMean(const std::vector<std::optional<Eigen::Matrix3d>>& bounds) {
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();
  for (const auto& bound : bounds) {
    if (!bound) return std::nullopt;
    variances += bound->diagonal() / static_cast<double>(bounds.size());
  }
  if (bounds.empty()) return std::nullopt;
  return ErrorBounds{.all = std::sqrt(variances.sum()),
                     .depth = std::sqrt(variances.z()),
                     .across = std::sqrt(variances.head<2>().sum())};
}

// Names of the levels that some cell has.
std::vector<std::string> LevelNames(const std::vector<CellBounds>& cells) {
  std::vector<std::string> names;
  for (const CellBounds& cell : cells) {
    for (const auto& level : cell.levels) {
      if (std::find(names.begin(), names.end(), level.first) == names.end()) {
        names.push_back(level.first);
      }
    }
  }
  return names;
}

std::string LevelOf(const CellBounds& cell, const std::string& name) {
  for (const auto& [level, value] : cell.levels) {
    if (level == name) return ToString(value);
  }
  return "";
}

}  // namespace

CellBounds BoundsOfCell(const Study& study, const Cell& cell, int trials) {
  CellBounds result{.part = cell.part, .sensor = cell.sensor, .levels = cell.levels};
  const CellRunner runner(study, cell);
  std::array<std::vector<std::optional<Eigen::Matrix3d>>, kAllKnown.size()> bounds;
  for (int trial = 0; trial < trials; ++trial) {
    const SimulatedTrial simulated = runner.Simulate(trial);
    if (!simulated.truth.in_view) continue;
    ++result.in_view;
    for (size_t i = 0; i < kAllKnown.size(); ++i) {
      const auto& information = simulated.information;
      bounds[i].push_back(information
                              ? BoundOf(*information, PriorKnowledgeFor(kAllKnown[i], *information))
                              : std::nullopt);
    }
  }
  for (size_t i = 0; i < kAllKnown.size(); ++i) result.bounds[i] = RootMean(bounds[i]);
  return result;
}

std::string BoundTable(const std::vector<CellBounds>& cells) {
  const std::vector<std::string> levels = LevelNames(cells);
  TextTable table;
  table.AddColumn("part", TextTable::Align::kLeft);
  table.AddColumn("sensor", TextTable::Align::kLeft);
  for (const std::string& name : levels) table.AddColumn(name);
  table.AddColumn("n");
  for (const char* heading :
       {"told z", "told 3D", "geom z", "geom 3D", "size z", "size 3D", "both z", "both 3D"}) {
    table.AddColumn(heading);
  }
  for (const CellBounds& cell : cells) {
    std::vector<std::string> row = {cell.part, ToString(cell.sensor)};
    for (const std::string& name : levels) row.push_back(LevelOf(cell, name));
    row.push_back(std::to_string(cell.in_view));
    for (const auto& bounds : cell.bounds) {
      row.push_back(Significant(bounds ? ToMilli(bounds->depth) : std::nullopt));
      row.push_back(Significant(bounds ? ToMilli(bounds->all) : std::nullopt));
    }
    table.AddRow(std::move(row));
  }
  return table.ToPlainText();
}

}  // namespace fenestra
