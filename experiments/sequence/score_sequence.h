#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/detection/detection_json.h"
#include "experiments/analysis/cell_summary.h"
#include "experiments/sequence/sequence.h"
#include "experiments/trial/detector_maker.h"

namespace fenestra {

/// The detections of a detector that runs elsewhere, one for each image of a sequence, in order.
struct MadeDetections {
  std::string label;
  std::vector<TimedDetection> detections;
};

/// Reads detections as `fenestra detect --json` prints them, one after the other; white space
/// between them is free. Throws InputError, also if they are not `frames` in number.
MadeDetections ReadDetections(const std::string& label, const std::filesystem::path& file,
                              size_t frames);

/// A recorded sequence that is scored into a results folder: results.sqlite, trials.csv,
/// summary.csv and summary.md, as those of a study (run_study.h). Every detector of the sequence
/// sees every image; detections that were made elsewhere count as those of one more detector.
struct SequenceRun {
  Sequence sequence;
  std::vector<MadeDetections> made;
  std::filesystem::path out;
  bool restart = false;  ///< Replaces another result that is there.
  std::shared_ptr<DetectorMaker> detectors = std::make_shared<DetectorMaker>();
};

/// Scores every image under every detector; the rows have the cells and trials that the sequence
/// gives. Throws InputError for a file that cannot be read, and where another process writes into
/// the folder or it holds the result of a study or of another sequence; nothing is written then.
std::vector<CellSummary> ScoreSequence(const SequenceRun& run);

}  // namespace fenestra
