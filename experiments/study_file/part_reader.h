#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/io/yaml_reader.h"
#include "experiments/study/study.h"
#include "experiments/study_file/study_blocks.h"
#include "vision/detector_registry.h"

namespace fenestra {

/// The keys of a part.
const std::vector<std::string>& PartKeys();

/// A part while its study is read: what the study says for all parts, and what the part says.
struct PartDraft {
  std::string name;
  StudyBlock common;
  StudyBlock own;

  bool sound() const { return common.sound && own.sound; }
  /// Where the factor was given; nullptr for a default.
  const GivenFactor* FindFactor(const std::string& factor) const {
    const GivenFactor* given = own.FindFactor(factor);
    return given != nullptr ? given : common.FindFactor(factor);
  }
};

/// Reads the parts of a study; a study without any has the single part "main". Faults are noted in
/// the reader.
std::vector<PartDraft> ReadParts(YamlReader& reader, std::span<const DetectorInfo> known);

/// The part with nothing left to defaults: the study's factors with the part's in their places,
/// then the defaults of all others, and of all these those that can have an effect; everything else
/// as the part says, or else the study. Notes a fault where the part lacks repetitions or a
/// detector for a sensor, or where its rules cannot work.
StudyPart ResolvePart(YamlReader& reader, const PartDraft& draft,
                      std::span<const DetectorInfo> known);

}  // namespace fenestra
