#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/study.h"
#include "experiments/trial/detector_maker.h"

namespace fenestra {

/// The cost of one trial of a cell, measured by running some.
struct TrialCost {
  double cell_s = 0.0;       ///< Time to make ready what the cell's trials share.
  double trial_s = 0.0;      ///< Time on one thread with all detectors.
  double row_bytes = 0.0;    ///< Size of a trial's rows in results.sqlite and trials.csv.
  double picture_bytes = 0;  ///< Size of the pictures of a cell's first trial.
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

/// The cells that a study will run. With probes > 0, that many trials of the first and the last
/// cell of each class are run to measure its cost; their mean stands for the class.
std::vector<CellClass> ExplainStudy(const Study& study, int probes,
                                    const std::shared_ptr<DetectorMaker>& detectors);

/// The cells' classes as text with totals; times are for this number of jobs.
std::string ExplanationText(const Study& study, const std::vector<CellClass>& classes, int jobs);

}  // namespace fenestra
