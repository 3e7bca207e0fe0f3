#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/detection/observation.h"
#include "core/io/parameter_table.h"
#include "experiments/study/distribution.h"
#include "experiments/study/envelope_rule.h"
#include "experiments/study/factors.h"
#include "experiments/study/sampling_design.h"
#include "experiments/study/stopping_rule.h"
#include "experiments/study/trial_settings.h"
#include "vision/detector_registry.h"
#include "vision/external/external_command.h"

namespace fenestra {

inline constexpr int64_t kMostCells = 10'000;
inline constexpr int64_t kMostTrials = 1'000'000;

/// The values of a factor that are compared with each other; a single one is a fixed value.
using Levels = std::vector<ParameterValue>;

/// How a study sets one factor. Numbers have the unit of the factor's name.
struct Factor {
  std::string name;
  std::variant<Levels, Distribution> setting;

  bool operator==(const Factor&) const = default;
};

/// How a detector runs outside of this process, where a crash or a hang costs it one trial.
struct DetectorProcess {
  /// A program of the user's own; empty: this one, which serves a detector that it knows by name.
  std::vector<std::string> command{};
  double time_limit_s = ExternalCommand{}.time_limit_s;
  double start_limit_s = ExternalCommand{}.start_limit_s;

  bool operator==(const DetectorProcess&) const = default;
};

/// A detector under test with all its options. The label names it in results, where the same
/// detector may stand several times with different options.
struct DetectorChoice {
  std::string label;
  std::string name;
  SensorKind sensor;
  OptionValues options;
  std::optional<DetectorProcess> process{};  ///< Absent: in this process.

  bool operator==(const DetectorChoice&) const = default;
};

/// The detector with all its options at their defaults.
DetectorChoice DefaultChoice(const DetectorInfo& detector);

/// One grid of conditions.
struct StudyPart {
  std::string name;
  std::vector<SensorKind> sensors;
  std::vector<DetectorChoice> detectors;
  /// Every factor that concerns this part: those that the study gives, in the order in which it
  /// gives them, then all others at their defaults.
  std::vector<Factor> factors;
  int repetitions;  ///< Trials of each cell.
  SamplingDesign design{};
  std::optional<StoppingRule> until{};     ///< When a cell may have fewer trials.
  std::optional<EnvelopeRule> envelope{};  ///< Which cells are run at all.

  bool operator==(const StudyPart&) const = default;
};

/// A question with everything that its answer depends on: nothing is left to defaults.
struct Study {
  std::string name;  ///< [a-z0-9_-]+
  std::string description;
  uint64_t seed;
  /// Whether every cell has random numbers of its own. Otherwise the same trial of different cells
  /// shares them, so that differences between cells are not blurred by different luck.
  bool independent_cells;
  std::vector<StudyPart> parts;

  bool operator==(const Study&) const = default;
};

/// One condition: one level of each factor, seen by one sensor.
struct Cell {
  int index;          ///< In the study, from 0.
  size_t part_index;  ///< Into Study::parts.
  std::string part;
  SensorKind sensor;
  /// Levels of the factors that concern the sensor and have several in any part of the study, so
  /// that the cells of all parts can be told apart; a factor that is drawn here is not among them.
  FactorValues levels;
  /// With all fixed values and levels; factors with distributions are at their defaults.
  TrialSettings settings;
  int repetitions;
};

/// All cells: part by part, in each sensor by sensor, in each the full grid of levels in the order
/// in which the factors stand, the last one running fastest.
std::vector<Cell> Cells(const Study& study);

/// One of them. Throws InputError unless the index is in range.
Cell CellOf(const Study& study, int index);

/// How many cells and trials the study has, without making them. At most 10^18 each, however large
/// the grid is.
int64_t CountCells(const Study& study);
int64_t CountTrials(const Study& study);

/// The detectors that work on the cell's sensor.
std::vector<DetectorChoice> DetectorsOf(const Study& study, const Cell& cell);

/// The factors of the cell's part that are drawn anew in every trial and concern its sensor.
std::vector<std::pair<std::string, Distribution>> DrawnFactors(const Study& study,
                                                               const Cell& cell);

}  // namespace fenestra
