#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/io/faults.h"

namespace fenestra {

/// A YAML document that is read with positions: every wrong value becomes a fault with file, line
/// and column, reading goes on, and ThrowIfFaulty reports all of them at once. The readers return
/// nullopt for what they have noted as a fault.
class YamlReader {
 public:
  /// Reads a file of at most 4 MiB. Throws InputError if it is missing, larger, empty, not UTF-8
  /// text, not YAML, or of more than one document. Accepts the "%YAML:1.0" first line of OpenCV's
  /// FileStorage.
  static YamlReader FromFile(const std::filesystem::path& file);
  static YamlReader FromText(const std::string& text, const std::string& source);

  const YAML::Node& root() const { return root_; }
  const std::string& source() const { return source_; }
  /// The text that was read, without changes.
  const std::string& text() const { return text_; }

  void AddFault(const YAML::Node& at, const std::string& message);
  /// See Faults::count.
  size_t fault_count() const { return faults_.count(); }
  /// `value`, or nullopt if a fault was noted after there were `count`.
  template <typename T>
  std::optional<T> IfSoundSince(size_t count, T value) const {
    return fault_count() == count ? std::optional<T>(std::move(value)) : std::nullopt;
  }
  void ThrowIfFaulty();

  /// Notes a fault unless `node` is a mapping whose keys are unique and all among `allowed`.
  bool CheckKeys(const YAML::Node& node, const std::string& what,
                 std::span<const std::string> allowed);

  /// `what` names the value in the message: "repetitions must be a number, not 'many'".
  std::optional<double> Number(const YAML::Node& node, const std::string& what);
  std::optional<int64_t> Integer(const YAML::Node& node, const std::string& what, int64_t min,
                                 int64_t max);
  std::optional<bool> Boolean(const YAML::Node& node, const std::string& what);
  std::optional<std::string> Text(const YAML::Node& node, const std::string& what);
  /// Exactly `count` numbers, or any number of them for count 0.
  std::optional<std::vector<double>> Numbers(const YAML::Node& node, const std::string& what,
                                             size_t count = 0);

  /// The value's text as a person would quote it, cut to 40 characters; "a list", "a mapping".
  static std::string Describe(const YAML::Node& node);

 private:
  YamlReader(std::string text, std::string source);

  std::string text_;
  std::string source_;
  YAML::Node root_;
  Faults faults_;
};

/// The text as a double-quoted YAML scalar, whatever characters it has.
std::string YamlQuoted(const std::string& text);

}  // namespace fenestra
