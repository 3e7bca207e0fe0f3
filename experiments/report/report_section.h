#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/analysis/cell_summary.h"
#include "experiments/output/text_table.h"

namespace fenestra {

/// The summaries of one part and one sensor, which share a table. Refers to the summaries that it
/// was made from.
struct ReportSection {
  std::string part;
  SensorKind sensor = SensorKind::kStereo;
  std::vector<const CellSummary*> rows;
  /// In the order in which they first occur.
  std::vector<std::string> detectors;
  /// Names of the levels that are not the same in all rows of this or of another section, as far
  /// as this section has them.
  std::vector<std::string> varying;
  bool has_attempts = false;      ///< Some trial has a target, in view or not.
  bool has_empty_scenes = false;  ///< Some trial has no target.
  bool has_bounds = false;        ///< Some row's errors have a bound.
};

/// In the order in which part and sensor first occur.
std::vector<ReportSection> MakeSections(std::span<const CellSummary> summaries);

/// Time for one detection in S. Zhou, G. Flores, R. Lozano, P. Castillo, "Vision-Based Window
/// Estimation for MAV in Unknown Urban Environments", IFAC RED-UAS 2013, on a machine that the
/// paper does not name.
double PaperMilliseconds(SensorKind sensor);

/// "near: rgbd, paper-rgbd".
std::string Heading(const ReportSection& section);

/// The columns that say which cell and detector a row belongs to: the varying levels, and the
/// detector where there are several.
void AddKeyColumns(const ReportSection& section, TextTable& table);
std::vector<std::string> KeyCells(const ReportSection& section, const CellSummary& row);

/// Appends a name unless it is there.
void AppendNew(const std::string& name, std::vector<std::string>& names);

}  // namespace fenestra
