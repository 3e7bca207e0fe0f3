#include "experiments/study/study.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/io/input_error.h"
#include "core/system/check.h"

namespace fenestra {
namespace {

constexpr int64_t kUncountable = 1'000'000'000'000'000'000;

int64_t SaturatedProduct(int64_t a, int64_t b) {
  return a != 0 && b > kUncountable / a ? kUncountable : a * b;
}

int64_t SaturatedSum(int64_t a, int64_t b) {
  return std::min(kUncountable, a + b);
}

const Levels* LevelsOf(const Factor& factor, SensorKind sensor) {
  if (!Concerns(GroupOf(factor.name), sensor)) return nullptr;
  return std::get_if<Levels>(&factor.setting);
}

int64_t CountCells(const StudyPart& part, SensorKind sensor) {
  int64_t count = 1;
  for (const Factor& factor : part.factors) {
    const Levels* levels = LevelsOf(factor, sensor);
    if (levels != nullptr) count = SaturatedProduct(count, static_cast<int64_t>(levels->size()));
  }
  return count;
}

int64_t CountCells(const StudyPart& part) {
  int64_t count = 0;
  for (const SensorKind sensor : part.sensors) {
    count = SaturatedSum(count, CountCells(part, sensor));
  }
  return count;
}

TrialSettings FixedSettings(const StudyPart& part, SensorKind sensor) {
  TrialSettings settings;
  for (const Factor& factor : part.factors) {
    const Levels* levels = LevelsOf(factor, sensor);
    if (levels != nullptr) Factors().Set(settings, factor.name, levels->front());
  }
  return settings;
}

std::set<std::string> NamesOfVariedFactors(const Study& study) {
  std::set<std::string> names;
  for (const StudyPart& part : study.parts) {
    for (const Factor& factor : part.factors) {
      const Levels* levels = std::get_if<Levels>(&factor.setting);
      if (levels != nullptr && levels->size() > 1) names.insert(factor.name);
    }
  }
  return names;
}

std::vector<const Factor*> VariedFactors(const StudyPart& part, SensorKind sensor,
                                         const std::set<std::string>& names) {
  std::vector<const Factor*> varied;
  for (const Factor& factor : part.factors) {
    if (names.contains(factor.name) && LevelsOf(factor, sensor)) varied.push_back(&factor);
  }
  return varied;
}

// The levels of grid point `point`, whose digits in mixed radix are the level indices.
FactorValues LevelsAt(const std::vector<const Factor*>& varied, int64_t point) {
  FactorValues values(varied.size());
  for (size_t i = varied.size(); i-- > 0;) {
    const Levels& levels = std::get<Levels>(varied[i]->setting);
    const auto radix = static_cast<int64_t>(levels.size());
    values[i] = {varied[i]->name, levels[static_cast<size_t>(point % radix)]};
    point /= radix;
  }
  return values;
}

TrialSettings With(TrialSettings settings, const FactorValues& values) {
  for (const auto& [factor, value] : values) Factors().Set(settings, factor, value);
  return settings;
}

}  // namespace

std::vector<Cell> Cells(const Study& study) {
  FENESTRA_CHECK(CountCells(study) <= kMostCells, "too many cells");
  const std::set<std::string> names = NamesOfVariedFactors(study);
  std::vector<Cell> cells;
  for (size_t p = 0; p < study.parts.size(); ++p) {
    const StudyPart& part = study.parts[p];
    for (const SensorKind sensor : part.sensors) {
      const TrialSettings fixed = FixedSettings(part, sensor);
      const std::vector<const Factor*> varied = VariedFactors(part, sensor, names);
      const int64_t count = CountCells(part, sensor);
      for (int64_t point = 0; point < count; ++point) {
        const FactorValues levels = LevelsAt(varied, point);
        cells.push_back({.index = static_cast<int>(cells.size()),
                         .part_index = p,
                         .part = part.name,
                         .sensor = sensor,
                         .levels = levels,
                         .settings = With(fixed, levels),
                         .repetitions = part.repetitions});
      }
    }
  }
  return cells;
}

Cell CellOf(const Study& study, int index) {
  std::vector<Cell> cells = Cells(study);
  if (index < 0 || index >= static_cast<int>(cells.size())) {
    throw InputError("--cell", fmt::format("{} is not a cell of '{}': 0 to {}", index, study.name,
                                           cells.size() - 1));
  }
  return std::move(cells[static_cast<size_t>(index)]);
}

int64_t CountCells(const Study& study) {
  int64_t count = 0;
  for (const StudyPart& part : study.parts) count = SaturatedSum(count, CountCells(part));
  return count;
}

int64_t CountTrials(const Study& study) {
  int64_t count = 0;
  for (const StudyPart& part : study.parts) {
    count = SaturatedSum(count, SaturatedProduct(CountCells(part), part.repetitions));
  }
  return count;
}

std::vector<DetectorChoice> DetectorsOf(const Study& study, const Cell& cell) {
  std::vector<DetectorChoice> detectors;
  for (const DetectorChoice& detector : study.parts[cell.part_index].detectors) {
    if (detector.sensor == cell.sensor) detectors.push_back(detector);
  }
  return detectors;
}

std::vector<std::pair<std::string, Distribution>> DrawnFactors(const Study& study,
                                                               const Cell& cell) {
  std::vector<std::pair<std::string, Distribution>> drawn;
  for (const Factor& factor : study.parts[cell.part_index].factors) {
    const Distribution* distribution = std::get_if<Distribution>(&factor.setting);
    if (distribution != nullptr && Concerns(GroupOf(factor.name), cell.sensor)) {
      drawn.emplace_back(factor.name, *distribution);
    }
  }
  return drawn;
}

DetectorChoice DefaultChoice(const DetectorInfo& detector) {
  DetectorChoice choice{
      .label = detector.name, .name = detector.name, .sensor = detector.sensor, .options = {}};
  if (detector.isolate) choice.process = DetectorProcess{};
  for (const ParameterInfo& option : detector.options) {
    choice.options[option.name] = WrittenDefault(option);
  }
  return choice;
}

}  // namespace fenestra
