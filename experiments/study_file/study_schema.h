#pragma once

#include <span>
#include <string>

#include "vision/detector_registry.h"

namespace fenestra {

/// A JSON Schema (draft 07) of study files, for editors that complete and check YAML by one. Made
/// of the tables that the reader uses: factors and detector options with their ranges, choices,
/// defaults and descriptions, and the reader's keys, each of which must have a schema.
/// The reader may still refuse what the schema accepts: factors that have no effect, contradictions
/// between settings, sizes. It refuses everything that the schema refuses.
std::string StudySchema(std::span<const DetectorInfo> known_detectors);

}  // namespace fenestra
