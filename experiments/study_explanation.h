#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/detector_maker.h"
#include "experiments/study.h"

namespace fenestra {

/// What one trial of a cell takes, measured by running some.
struct TrialCost {
  double cell_s = 0.0;       ///< To make ready what the cell's trials share.
  double trial_s = 0.0;      ///< On one thread, all detectors.
  double row_bytes = 0.0;    ///< Of a trial's rows in results.sqlite and trials.csv.
  double picture_bytes = 0;  ///< Of the pictures of a cell's first trial.
};

/// Runs `trials` ≥ 1 trials of the cell, and stores the rows and pictures in a folder for temporary
/// files to see how large they are.
TrialCost MeasureCost(const Study& study, const Cell& cell, int trials,
                      const std::shared_ptr<DetectorMaker>& detectors);

/// The cells of one part before one sensor.
struct CellClass {
  std::string part;
  SensorKind sensor;
  int64_t cells = 0;
  int64_t trials = 0;
  std::vector<std::string> detectors;
  /// Name and setting as a study file would give it: "[2, 3]", "{uniform: [-1, 1]}".
  std::vector<std::pair<std::string, std::string>> varied;
  std::vector<std::pair<std::string, std::string>> drawn;
  std::string design;  ///< "latin_hypercube; Spearman's ρ of yaw_deg and roll_deg: 0.5"
  std::optional<TrialCost> cost;
};

/// What a study will run. With probes > 0, that many trials of the first and the last cell of each
/// class are run to measure its cost; their mean stands for the class.
std::vector<CellClass> ExplainStudy(const Study& study, int probes,
                                    const std::shared_ptr<DetectorMaker>& detectors);

/// The above for people, with totals; times for this number of jobs.
std::string ExplanationText(const Study& study, const std::vector<CellClass>& classes, int jobs);

}  // namespace fenestra
