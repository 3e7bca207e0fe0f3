#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/study/study.h"

namespace fenestra {

/// A detector's prior knowledge of the window (core/detection/window_prior.h), as reports show it:
/// "expected_height_m 1, expected_width_m 1"; empty if nothing.
std::string PriorText(const DetectorChoice& detector);

/// PriorText of all detectors of a study: "Prior of edge-stereo in street" and its text. One entry,
/// "Prior" and "none", where no detector has any.
std::vector<std::pair<std::string, std::string>> PriorEntries(const Study& study);

}  // namespace fenestra
