#pragma once

#include <filesystem>
#include <string>

#include "core/io/output_path.h"
#include "experiments/sequence/sequence.h"
#include "experiments/study/study.h"

namespace fenestra {

/// The file that ReadSequence reads, its paths as they are. Frames have a calibration each; which
/// detectors shall see them is left open.
std::string ToYaml(const Sequence& sequence);

/// Writes every trial of a study's cells of one sensor as a recorded sequence with its truth:
/// sequence.yaml (see sequence.h) and, for each trial, a folder with what a detector gets. Scoring
/// it gives the rows of the study. Returns the number of frames. Throws InputError if no cell has
/// that sensor.
int WriteSequence(const OutputPath& folder, const Study& study, SensorKind sensor);

}  // namespace fenestra
