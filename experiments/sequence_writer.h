#pragma once

#include <filesystem>

#include "experiments/study.h"

namespace fenestra {

/// Writes every trial of a study's cells of one sensor as a recorded sequence with its truth:
/// sequence.yaml (see sequence.h) and, for each trial, a folder with what a detector gets. Scoring
/// it gives the rows of the study. Returns the number of frames. Throws InputError if no cell has
/// that sensor.
int WriteSequence(const std::filesystem::path& folder, const Study& study, SensorKind sensor);

}  // namespace fenestra
