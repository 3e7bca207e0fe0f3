#pragma once

#include <string>

#include "experiments/study/study.h"

namespace fenestra {

/// The study as YAML with everything written out: every factor of every part, every option of
/// every detector, and the version of Fenestra that resolved it. ReadStudy makes the same study
/// of it, bit by bit.
std::string ToYaml(const Study& study);

/// The setting of one factor as a study file would give it: "[1.4, 2]", "{uniform: [-3, 3]}".
std::string ToYaml(const std::variant<Levels, Distribution>& setting);

}  // namespace fenestra
