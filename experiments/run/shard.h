#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "experiments/trial/trial_record.h"

namespace fenestra {

/// A share of a study's trials, for one of several machines: of all trials in order, every
/// count-th one, beginning with number `index`. Shares differ by one trial at most, and each has
/// its part of every cell, however long a cell's trials take.
struct Shard {
  int index = 1;  ///< 1 to count.
  int count = 1;

  /// "2/8".
  std::string ToString() const;
  /// Throws InputError, as an error of the option --shard, for any other text.
  static Shard Parse(const std::string& text);

  /// The share of `all`, in their order.
  std::vector<TrialKey> Of(std::span<const TrialKey> all) const;

  bool operator==(const Shard&) const = default;
};

}  // namespace fenestra
