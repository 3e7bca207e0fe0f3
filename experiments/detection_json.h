#pragma once

#include <string>

#include "core/detection.h"
#include "core/stage_log.h"

namespace fenestra {

/// A detection as JSON: "outcome" is "window" or "miss"; metres in the scored camera's frame; all
/// digits of every double.
std::string DetectionJson(const std::string& detector, const Detection& detection,
                          const StageLog& log);

/// The same for people.
std::string DetectionText(const std::string& detector, const Detection& detection,
                          const StageLog& log);

}  // namespace fenestra
