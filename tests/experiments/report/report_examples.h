#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/trial/record_examples.h"

namespace fenestra::testing {

inline std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Two sensors, two detectors on one of them, all outcomes; one part without a window.
inline std::vector<TrialRecord> ExampleRows() {
  std::vector<TrialRecord> rows;
  for (int cell = 0; cell < 3; ++cell) {
    for (int trial = 0; trial < 20; ++trial) {
      for (const char* detector : {"paper-stereo", "other"}) {
        rows.push_back(RandomHit(cell, trial, detector));
      }
    }
  }
  rows[0] = Row(0, 0, Outcome::kMissed, "paper-stereo");
  rows[2] = Row(0, 1, Outcome::kMissed, "paper-stereo");
  rows[4] = RowWithError(0, 2, Outcome::kGross, {0.0, 0.0, 0.7}, "paper-stereo");
  rows[6] = Row(0, 3, Outcome::kOutOfView, "paper-stereo");
  for (int trial = 0; trial < 8; ++trial) {
    TrialRecord row = Row(3, trial, trial == 0 ? Outcome::kFalseAlarm : Outcome::kClear, "empty");
    row.part = "no_window";
    row.sensor = SensorKind::kRgbd;
    row.levels.clear();
    row.stages = {{"segment", 0.0123}};
    rows.push_back(row);
  }
  return rows;
}

}  // namespace fenestra::testing
