#include "experiments/sequence/score_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "core/io/input_error.h"
#include "core/io/input_file.h"
#include "core/io/temporary_files.h"
#include "core/system/program.h"
#include "experiments/analysis/cell_tally.h"
#include "experiments/report/report.h"
#include "experiments/run/result_files.h"
#include "experiments/run/run_identity.h"
#include "experiments/store/store.h"
#include "experiments/trial/scoring.h"

namespace fenestra {
namespace {

/// One detector, built again where the calibration changes.
class SequenceDetector {
 public:
  SequenceDetector(DetectorChoice choice, std::shared_ptr<DetectorMaker> maker)
      : choice_(std::move(choice)), maker_(std::move(maker)) {}

  TrialRecord Try(const SequenceFrame& frame, const RecordedObservation& recorded) {
    StageLog log(SteadyClock());
    const auto detect = [&] {
      if (!detector_ || !(calibration_ == recorded.calibration)) {
        detector_ = maker_->Make(choice_, recorded.calibration);
        calibration_ = recorded.calibration;
      }
      return detector_->Detect(recorded.observation, log);
    };
    const auto outcome = DetectionOrCrash(detect, DetectorMaker::IsOwn(choice_));
    log.End();
    return RecordOf(frame, choice_.label, outcome, log.times());
  }

  static TrialRecord RecordOf(const SequenceFrame& frame, const std::string& label,
                              const std::variant<Detection, Crash>& outcome,
                              const std::vector<StageTime>& stages) {
    return {.cell = frame.cell,
            .trial = frame.trial,
            .part = frame.part,
            .sensor = frame.files.sensor,
            .detector = label,
            .levels = frame.levels,
            .drawn = frame.drawn,
            .score = ScoreDetection(outcome, frame.truth),
            .stages = stages};
  }

 private:
  DetectorChoice choice_;
  std::shared_ptr<DetectorMaker> maker_;
  std::unique_ptr<Detector> detector_;
  std::optional<SensorCalibration> calibration_;
};

std::vector<std::vector<TrialRecord>> TryAll(const SequenceRun& run) {
  std::vector<SequenceDetector> detectors;
  for (const DetectorChoice& choice : run.sequence.detectors) {
    run.detectors->Start(choice);
    detectors.emplace_back(choice, run.detectors);
  }
  std::vector<std::vector<TrialRecord>> trials;
  for (size_t i = 0; i < run.sequence.frames.size(); ++i) {
    const SequenceFrame& frame = run.sequence.frames[i];
    const RecordedObservation recorded = ReadObservation(frame.files);
    std::vector<TrialRecord>& rows = trials.emplace_back();
    for (SequenceDetector& detector : detectors) rows.push_back(detector.Try(frame, recorded));
    for (const MadeDetections& made : run.made) {
      const TimedDetection& said = made.detections.at(i);
      rows.push_back(SequenceDetector::RecordOf(frame, made.label, said.detection, said.stages));
    }
  }
  return trials;
}

StoreMetadata MetadataOf(const SequenceRun& run) {
  return {{"sequence", run.sequence.text},
          {"name", run.sequence.name},
          {"version", Version()},
          {"libraries", LibraryVersions()},
          {"processor", Processor()}};
}

// A result that this sequence has not given stays.
void CheckMayReplace(const SequenceRun& run) {
  const std::filesystem::path file = run.out / ResultStore::kFileName;
  if (!std::filesystem::exists(file)) return;
  const StoreMetadata there = ResultStore::OpenReadOnly(file).Metadata();
  const auto sequence = there.find("sequence");
  if (sequence != there.end() && sequence->second == run.sequence.text) return;
  throw InputError(file,
                   fmt::format("holds another result, of the {} '{}'. Choose another --out, "
                               "or replace it with --restart",
                               sequence == there.end() ? "study" : "sequence", there.at("name")));
}

// Of the targets, by cell and trial.
std::map<std::pair<int, int>, double> SidesOf(const Sequence& sequence) {
  std::map<std::pair<int, int>, double> sides_m;
  for (const SequenceFrame& frame : sequence.frames) {
    if (!frame.truth.target) continue;
    sides_m[{frame.cell, frame.trial}] =
        std::min(frame.truth.target->width_m, frame.truth.target->height_m);
  }
  return sides_m;
}

void WriteReports(const SequenceRun& run, const std::vector<TrialRecord>& records,
                  const std::vector<CellSummary>& summaries, const OutputPath& out) {
  const ReportTitle title{
      .study = run.sequence.name,
      .description = run.sequence.description,
      .provenance = {{"Frames", fmt::format("{}, recorded", run.sequence.frames.size())},
                     {"Fenestra", Version()},
                     {"Libraries", LibraryVersions()},
                     {"Processor", Processor()}}};
  WriteFileAtomically(out / "trials.csv", TrialsCsv(records));
  WriteFileAtomically(out / "summary.csv", SummaryCsv(summaries));
  WriteFileAtomically(out / "summary.md", SummaryMarkdown(title, summaries));
}

}  // namespace

MadeDetections ReadDetections(const std::string& label, const std::filesystem::path& file,
                              size_t frames) {
  std::ifstream stream = OpenInput(file);
  MadeDetections made{.label = label, .detections = {}};
  try {
    while ((stream >> std::ws).good() && stream.peek() != std::ifstream::traits_type::eof()) {
      nlohmann::ordered_json json;
      stream >> json;
      made.detections.push_back(DetectionFromJson(json));
    }
  } catch (const std::runtime_error& error) {
    throw InputError(file,
                     fmt::format("detection {}: {}", made.detections.size() + 1, error.what()));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file,
                     fmt::format("detection {}: {}", made.detections.size() + 1, error.what()));
  }
  if (made.detections.size() != frames) {
    throw InputError(file, fmt::format("has {} detections; the sequence has {} frames",
                                       made.detections.size(), frames));
  }
  return made;
}

std::vector<CellSummary> ScoreSequence(const SequenceRun& run) {
  const FolderLock lock(run.out);
  const OutputPath out = ResultsFolder(run.out);
  if (!run.restart) CheckMayReplace(run);
  out.RequireWritable();
  const auto trials = TryAll(run);
  out.StartRecord();
  ResultStore store = ResultStore::Create(run.out / ResultStore::kFileName, MetadataOf(run),
                                          ResultStore::IfExists::kReplace);
  RemoveResultFiles(out);
  for (const auto& rows : trials) store.AddTrial(rows);
  const std::vector<TrialRecord> records = store.Rows();
  std::vector<CellSummary> summaries = Summarise(records, RowContext(SidesOf(run.sequence)));
  WriteReports(run, records, summaries, out);
  return summaries;
}

}  // namespace fenestra
