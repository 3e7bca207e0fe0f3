#pragma once

#include "experiments/study/study.h"

namespace fenestra {

/// The causes of a cell's errors in a sensitivity design: those of its part, without the sources
/// that do nothing in this cell (a rig or unit that all trials share or that is as told; a
/// calibration, of the RGB-D sensor) and without causes that have no source left. Empty with other
/// designs.
std::vector<Cause> CausesOf(const Study& study, const Cell& cell);

/// The causes of a part whose study names none: noise (shot), calibration (rig, and calibration
/// with stereo), and the drawn factors by what they belong to: pose, light, scene, sensor.
std::vector<Cause> DefaultCauses(const StudyPart& part);

/// All sources of randomness of a part that a cause may name.
std::vector<std::string> SourcesOf(const StudyPart& part);

/// The place of a trial in a pick-freeze design of k causes: rows of k + 2 trials, one after the
/// other. All trials of a row have two draws of every cause, "first" and "second", in common:
/// column 0 uses the first of all causes, column 1 the second of all, column 2 + i the first of all
/// but cause i. Any number of whole rows is a design.
/// Source: A. Saltelli et al., "Variance based sensitivity analysis of model output", Computer
/// Physics Communications 181, 2010: matrices A, B and A_B^(i).
struct PickFreezePlace {
  int row;
  int column;

  static PickFreezePlace Of(int trial_index, size_t causes);
  bool UsesSecond(size_t cause) const {
    return column == 1 || column == 2 + static_cast<int>(cause);
  }
};

/// The number of trials in a row.
inline int PickFreezeColumns(size_t causes) {
  return static_cast<int>(causes) + 2;
}

}  // namespace fenestra
