#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/input_error.h"

namespace fenestra {

/// Collects the faults of one input, so that a single InputError reports all of them:
///
///     Faults faults("camera");
///     faults.Require(p.fx_px > 0.0, "the focal length must be positive");
///     faults.ThrowIfAny();
class Faults {
 public:
  /// `source`: the file or what the input is called, see InputFault; empty if each fault has its
  /// own. Of more than `most_reported` faults only the number of the others is reported.
  explicit Faults(std::string source = "",
                  size_t most_reported = std::numeric_limits<size_t>::max())
      : source_(std::move(source)), most_reported_(most_reported) {}

  /// A fault without a source of its own has the collector's.
  void AddFault(InputFault fault);
  void Add(std::string message) { AddFault({.message = std::move(message)}); }
  /// `place`: a JSON pointer (RFC 6901), which the message begins with; empty for the whole input.
  void Add(std::string_view place, std::string_view message);
  void Add(const std::vector<std::string>& messages);

  void Require(bool holds, std::string message) {
    if (!holds) Add(std::move(message));
  }
  /// Each of these also refuses what is not a number: "`name` must be positive, not nan".
  void RequirePositive(std::string_view name, double value);
  void RequireNotNegative(std::string_view name, double value);
  void RequireWithin(std::string_view name, double value, double min, double max);

  /// Grows with every fault: a reader that compares it with an earlier count learns whether what
  /// it has read since is sound.
  size_t count() const { return faults_.size() + left_out_; }

  /// Orders the faults by line and column; those at one place keep their order.
  void SortByPlace();
  /// Throws InputError with all faults, unless there are none.
  void ThrowIfAny() const;

 private:
  std::string source_;
  size_t most_reported_;
  std::vector<InputFault> faults_;
  size_t left_out_ = 0;
};

/// " Did you mean 'x'?" for the allowed word that is nearest to `word` by edit distance with
/// transpositions, or "" where none is near (more than a third of its letters differ).
std::string DidYouMean(std::string_view word, std::span<const std::string> allowed);

}  // namespace fenestra
