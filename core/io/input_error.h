#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace fenestra {

/// One fault of a file or an option: where it is, what was found and what is allowed.
struct InputFault {
  std::string source{};  ///< File path or option name; empty if there is none.
  int line = 0;        ///< 1-based; 0 where the fault has no line.
  int column = 0;      ///< 1-based; 0 where the fault has no column.
  std::string message;

  /// "source:line:column: message", leaving out what is unknown.
  std::string ToString() const;
};

/// Bad input from outside: a study, scene, calibration, image or option. Carries all faults of a
/// file at once; `what()` has one line for each.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<InputFault> faults);
  /// A single fault without a position.
  InputError(const std::filesystem::path& source, const std::string& message);

  const std::vector<InputFault>& faults() const { return faults_; }

 private:
  std::vector<InputFault> faults_;
};

/// The options, once their Validate has accepted them: for members that are initialised from them.
template <typename Options>
const Options& Validated(const Options& options) {
  Validate(options);
  return options;
}

}  // namespace fenestra
