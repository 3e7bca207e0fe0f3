#include "experiments/report/report_section.h"

#include <fmt/format.h>

#include <algorithm>

namespace fenestra {
namespace {

ReportSection& SectionOf(const CellSummary& row, std::vector<ReportSection>& sections) {
  for (ReportSection& section : sections) {
    if (section.part == row.part && section.sensor == row.sensor) return section;
  }
  ReportSection section;
  section.part = row.part;
  section.sensor = row.sensor;
  return sections.emplace_back(std::move(section));
}

std::vector<std::string> VaryingLevels(const ReportSection& section) {
  std::vector<std::string> names;
  for (const CellSummary* row : section.rows) {
    for (const auto& level : row->levels) AppendNew(level.first, names);
  }
  std::erase_if(names, [&](const std::string& name) {
    const std::string first = LevelText(section.rows.front()->levels, name);
    return std::all_of(section.rows.begin(), section.rows.end(), [&](const CellSummary* row) {
      return LevelText(row->levels, name) == first;
    });
  });
  return names;
}

}  // namespace

void AppendNew(const std::string& name, std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

std::vector<ReportSection> MakeSections(std::span<const CellSummary> summaries) {
  std::vector<ReportSection> sections;
  for (const CellSummary& row : summaries) {
    ReportSection& section = SectionOf(row, sections);
    section.rows.push_back(&row);
    AppendNew(row.detector, section.detectors);
    section.has_attempts |= row.in_view + row.counts[Outcome::kOutOfView] > 0;
    section.has_empty_scenes |= row.without_target > 0;
    section.has_bounds |= row.bounds.has_value();
  }
  // A section of a single cell shows its value of what varies in others.
  std::vector<std::string> varying;
  for (const ReportSection& section : sections) {
    for (const std::string& name : VaryingLevels(section)) AppendNew(name, varying);
  }
  for (ReportSection& section : sections) {
    section.varying = varying;
    std::erase_if(section.varying, [&section](const std::string& name) {
      return std::all_of(section.rows.begin(), section.rows.end(), [&name](const CellSummary* row) {
        return LevelText(row->levels, name).empty();
      });
    });
  }
  return sections;
}

double PaperMilliseconds(SensorKind sensor) {
  return sensor == SensorKind::kStereo ? 200.0 : 800.0;
}

std::string Heading(const ReportSection& section) {
  return fmt::format("{}: {}, {}", section.part, ToString(section.sensor),
                     fmt::join(section.detectors, ", "));
}

void AddKeyColumns(const ReportSection& section, TextTable& table) {
  for (const std::string& name : section.varying) table.AddColumn(name);
  if (section.detectors.size() > 1) table.AddColumn("detector", TextTable::Align::kLeft);
}

std::vector<std::string> KeyCells(const ReportSection& section, const CellSummary& row) {
  std::vector<std::string> cells;
  for (const std::string& name : section.varying) cells.push_back(LevelText(row.levels, name));
  if (section.detectors.size() > 1) cells.push_back(row.detector);
  return cells;
}

}  // namespace fenestra
