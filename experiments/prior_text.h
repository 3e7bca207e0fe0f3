#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/study.h"

namespace fenestra {

/// What a detector was told of the window beforehand (vision/window_prior.h), as reports show it:
/// "expected_height_m 1, expected_width_m 1"; empty if nothing.
std::string PriorText(const DetectorChoice& detector);

/// The same for all detectors of a study: "Prior of edge-stereo in street" and its text. One entry,
/// "Prior" and "none", where no detector was told anything.
std::vector<std::pair<std::string, std::string>> PriorEntries(const Study& study);

}  // namespace fenestra
