#include "experiments/run/study_explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/io/temporary_files.h"
#include "experiments/output/number_format.h"
#include "experiments/report/report.h"
#include "experiments/run/result_files.h"
#include "experiments/run/run_trials.h"
#include "experiments/sampling/causes.h"
#include "experiments/store/store.h"
#include "experiments/study_file/study_writer.h"
#include "experiments/trial/cell_runner.h"
#include "experiments/trial_files/trial_files.h"

namespace fenestra {
namespace fs = std::filesystem;
namespace {

std::string DesignText(const Study& study, const Cell& cell) {
  const SamplingDesign& design = study.parts[cell.part_index].design;
  std::string text = ToString(design.method);
  for (const FactorCorrelation& c : design.correlations) {
    text += fmt::format("; Spearman's ρ of {} and {}: {}", c.first, c.second, c.spearman);
  }
  if (design.method != DesignMethod::kSensitivity) return text;
  const std::vector<Cause> causes = CausesOf(study, cell);
  const int columns = PickFreezeColumns(causes.size());
  text += fmt::format("; {} rows of {} trials", cell.repetitions / columns, columns);
  if (cell.repetitions % columns != 0) {
    text += fmt::format(" ({} trials of an incomplete row are left out of the indices)",
                        cell.repetitions % columns);
  }
  for (const Cause& cause : causes) {
    text += fmt::format("; {}: {}", cause.name, fmt::join(cause.sources, ", "));
  }
  return text;
}

std::string RulesText(const StudyPart& part) {
  std::string text;
  if (part.until) {
    text += "; at most, until";
    for (const auto& [figure, width] : part.until->targets) {
      text += fmt::format(" {} is known to {:g}", ToString(figure), width);
    }
  }
  if (part.envelope) {
    text += fmt::format("; at most: an envelope over {} runs the cells near its boundary only",
                        part.envelope->over);
  }
  return text;
}

CellClass ClassOf(const Study& study, const Cell& first) {
  const StudyPart& part = study.parts[first.part_index];
  CellClass result{.part = first.part,
                   .sensor = first.sensor,
                   .detectors = {},
                   .varied = {},
                   .drawn = {},
                   .design = DesignText(study, first) + RulesText(part),
                   .cost = {}};
  for (const DetectorChoice& detector : DetectorsOf(study, first)) {
    result.detectors.push_back(detector.label);
  }
  for (const Factor& factor : part.factors) {
    if (!Concerns(GroupOf(factor.name), first.sensor)) continue;
    const Levels* levels = std::get_if<Levels>(&factor.setting);
    if (levels == nullptr) {
      result.drawn.emplace_back(factor.name, ToYaml(factor.setting));
    } else if (levels->size() > 1) {
      result.varied.emplace_back(factor.name, ToYaml(factor.setting));
    }
  }
  return result;
}

TrialCost Mean(const TrialCost& a, const TrialCost& b) {
  return {.cell_s = 0.5 * (a.cell_s + b.cell_s),
          .trial_s = 0.5 * (a.trial_s + b.trial_s),
          .row_bytes = 0.5 * (a.row_bytes + b.row_bytes),
          .picture_bytes = 0.5 * (a.picture_bytes + b.picture_bytes)};
}

double SecondsOf(const CellClass& cells, int jobs) {
  return (static_cast<double>(cells.cells) * cells.cost->cell_s +
          static_cast<double>(cells.trials) * cells.cost->trial_s) /
         jobs;
}

double BytesOf(const CellClass& cells) {
  return static_cast<double>(cells.cells) * cells.cost->picture_bytes +
         static_cast<double>(cells.trials) * cells.cost->row_bytes;
}

std::string Text(const CellClass& cells, int jobs) {
  std::string text = fmt::format("{}: {}, {} cell{} of {} trials = {} trials\n", cells.part,
                                 ToString(cells.sensor), cells.cells, cells.cells == 1 ? "" : "s",
                                 cells.trials / cells.cells, cells.trials);
  text += fmt::format("  detectors: {}\n", fmt::join(cells.detectors, ", "));
  for (const auto& [name, setting] : cells.varied) {
    text += fmt::format("  compared:  {}: {}\n", name, setting);
  }
  for (const auto& [name, setting] : cells.drawn) {
    text += fmt::format("  drawn:     {}: {}\n", name, setting);
  }
  text += fmt::format("  design:    {}\n", cells.design);
  if (cells.cost) {
    text += fmt::format("  takes:     about {} ({} ms a trial, {} ms to make a cell ready), {}\n",
                        Duration(SecondsOf(cells, jobs)), Significant(1e3 * cells.cost->trial_s),
                        Significant(1e3 * cells.cost->cell_s), Bytes(BytesOf(cells)));
  }
  return text;
}

// A store grows by whole pages, so a single trial would tell nothing.
double StoredBytes(std::vector<TrialRecord> rows, const fs::path& folder) {
  constexpr int kCopies = 100;
  const fs::path file = folder / "rows.sqlite";
  ResultStore store = ResultStore::Create(file, {});
  const auto empty = static_cast<double>(fs::file_size(file));
  for (int copy = 0; copy < kCopies; ++copy) {
    for (TrialRecord& row : rows) row.trial = copy;
    store.AddTrial(rows);
  }
  return (static_cast<double>(fs::file_size(file)) - empty) / kCopies;
}

double CsvBytes(const std::vector<TrialRecord>& rows) {
  return static_cast<double>(TrialsCsv(rows).size() - TrialsCsv({}).size());
}

}  // namespace

std::vector<CellClass> ExplainStudy(const Study& study, int probes,
                                    const std::shared_ptr<DetectorMaker>& detectors) {
  const std::vector<Cell> cells = Cells(study);
  std::vector<CellClass> classes;
  for (size_t begin = 0; begin < cells.size();) {
    size_t end = begin;
    CellClass here = ClassOf(study, cells[begin]);
    while (end < cells.size() && cells[end].part_index == cells[begin].part_index &&
           cells[end].sensor == cells[begin].sensor) {
      ++here.cells;
      here.trials += cells[end++].repetitions;
    }
    if (probes > 0) {
      here.cost = MeasureCost(study, cells[begin], probes, detectors);
      if (end - begin > 1)
        here.cost = Mean(*here.cost, MeasureCost(study, cells[end - 1], probes, detectors));
    }
    classes.push_back(std::move(here));
    begin = end;
  }
  return classes;
}

std::string ExplanationText(const Study& study, const std::vector<CellClass>& classes, int jobs) {
  std::string text =
      study.name + (study.description.empty() ? "" : ": " + study.description) + "\n\n";
  int64_t rows = 0;
  double seconds = 0.0;
  double bytes = 0.0;
  bool measured = true;
  for (const CellClass& cells : classes) {
    text += Text(cells, jobs) + "\n";
    rows += cells.trials * static_cast<int64_t>(cells.detectors.size());
    measured = measured && cells.cost.has_value();
    if (!cells.cost) continue;
    seconds += SecondsOf(cells, jobs);
    bytes += BytesOf(cells);
  }
  text += fmt::format("In all {} cells, {} trials, {} rows; seed {}; {}.\n", CountCells(study),
                      CountTrials(study), rows, study.seed,
                      study.independent_cells
                          ? "every cell has random numbers of its own"
                          : "the same trial of all cells shares its random numbers");
  if (measured) {
    text += fmt::format("About {} with {} job{}, and {} on disk.\n", Duration(seconds), jobs,
                        jobs == 1 ? "" : "s", Bytes(bytes));
  }
  return text;
}

TrialCost MeasureCost(const Study& study, const Cell& cell, int trials,
                      const std::shared_ptr<DetectorMaker>& detectors) {
  TrialCost cost;
  const Clock clock = SteadyClock();
  const double start_s = clock();
  const CellRunner runner(study, cell, detectors);
  const double ready_s = clock();
  cost.cell_s = ready_s - start_s;
  for (int trial = 0; trial < trials; ++trial) {
    const SimulatedTrial simulated = runner.Simulate(trial);
    for (size_t i = 0; i < runner.detectors().size(); ++i) runner.Try(i, simulated, false);
  }
  cost.trial_s = (clock() - ready_s) / trials;

  const SimulatedTrial simulated = runner.Simulate(0);
  std::vector<Attempt> attempts;
  for (size_t i = 0; i < runner.detectors().size(); ++i) {
    attempts.push_back(runner.Try(i, simulated, true));
  }
  const FinishedTrial finished{runner, simulated, attempts};
  const PrivateFolder scratch;
  WritePictures(scratch.path() / "pictures", finished);
  cost.picture_bytes = static_cast<double>(FolderSize(scratch.path() / "pictures"));
  cost.row_bytes = StoredBytes(finished.Records(), scratch.path()) + CsvBytes(finished.Records());
  return cost;
}

}  // namespace fenestra
