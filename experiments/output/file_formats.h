#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fenestra {

/// Fields and lines of a CSV file after RFC 4180, except that lines end with a line feed alone: a
/// field with a comma, a quote or a line break stands in quotes, and quotes in it are doubled. A
/// line's fields may have any number and order of types:
///
///     csv.Add("near, by day").Add(3).Add(0.5).EndLine();   // "near, by day",3,0.5
class CsvWriter {
 public:
  CsvWriter& Add(std::string_view field);
  /// Exact(value): the same bits when read back; empty for nullopt.
  CsvWriter& Add(std::optional<double> value);
  CsvWriter& Add(double value) { return Add(std::optional(value)); }  // Not Add(int).
  CsvWriter& Add(int value);
  CsvWriter& AddAll(const std::vector<std::string>& fields);
  void EndLine();

  const std::string& text() const { return text_; }
  /// Returns what was written since the last call.
  std::string TakeText() { return std::exchange(text_, {}); }

 private:
  std::string text_;
  bool line_is_empty_ = true;
};

/// A point cloud in the binary form of PCL's PCD format, version 0.7: x, y, z as 32-bit floats.
/// Written here, since PCL's own writer would bring VTK into the program.
std::string ToPcd(std::span<const Eigen::Vector3f> points);

}  // namespace fenestra
