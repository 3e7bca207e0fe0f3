#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/io/yaml_reader.h"
#include "experiments/study/study.h"
#include "vision/detector_registry.h"

namespace fenestra {

/// Reads a study. Throws InputError with all faults of the file and their positions.
///
///   name: paper                  # [a-z0-9_-]+
///   description: What it asks.   # optional
///   seed: 2013                   # 0 to 2^63 - 1; default 1
///   independent_cells: false     # default: the same trial of all cells shares random numbers
///   repetitions: 20              # trials per cell, 1 to 10^6
///   sensors: [stereo, rgbd]      # default: both
///   detectors: [paper-stereo, {name: paper-rgbd, label: mine, options: {…}}]
///                                # default: every detector of the sensors
///   design: sobol                # see design/design_reader.h; default: monte_carlo
///   factors:                     # see factor_reader.h
///     distance_m: [1.4, 2, 3]
///   parts:                       # default: a single part, "main"
///     - name: near
///       factors: {distance_m: [0.59, 0.78]}
///
/// A part may have repetitions, sensors, detectors, a design and factors of its own. Its factors
/// are put in the places of the study's factors of the same name, or behind them; everything else
/// replaces what the study says. Of the study's detectors a part takes those that work on its
/// sensors.
///
/// A factor that cannot have an effect where it is given is a fault, as are settings that
/// contradict each other, more than kMostCells cells and more than kMostTrials trials.
/// A key `fenestra_version` says which version resolved a study; it is not used.
Study ReadStudy(YamlReader reader, std::span<const DetectorInfo> known_detectors);
Study ReadStudyFile(const std::filesystem::path& file,
                    std::span<const DetectorInfo> known_detectors);

/// The keys of a study.
const std::vector<std::string>& StudyKeys();

}  // namespace fenestra
