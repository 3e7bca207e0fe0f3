#pragma once

#include <span>
#include <string>

#include "experiments/check/estimation.h"

namespace fenestra {

/// A detector now and in the baseline, trial by trial.
struct PairedTests {
  /// Errors of in-view attempts have grown, one without an estimate counting as +∞: signed ranks
  /// of |e now| - |e before| in each cell, scaled to [-1, 1] and averaged over the cells of a
  /// cluster, under SignFlipPValue.
  double p_errors_grew = 1.0;
  /// Hits have become fewer: lost less gained hits of a cluster, under SignFlipPValue.
  double p_hits_lost = 1.0;
  int pairs = 0;
  int clusters = 0;
  int changed = 0;  ///< Pairs whose errors differ at all.
};

PairedTests ComparePairs(std::span<const SelectedRow> rows);

}  // namespace fenestra
