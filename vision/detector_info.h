#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/detection/detector.h"
#include "core/geometry/calibration.h"
#include "core/io/parameter_table.h"
#include "core/system/check.h"

namespace fenestra {

/// Description of a detector that can be selected by name.
struct DetectorInfo {
  std::string name;  ///< "paper-stereo"
  SensorKind sensor;
  std::string description;  ///< One line.
  std::vector<ParameterInfo> options;
  /// Whether it runs in a separate process unless a study says otherwise; true for plugins.
  bool isolate = false;
};

using OptionValues = std::map<std::string, ParameterValue>;

/// Makes a detector from a calibration of its sensor and valid options. Throws InputError for
/// options that contradict each other.
using DetectorFactory =
    std::function<std::unique_ptr<Detector>(const SensorCalibration&, const OptionValues&)>;

/// Factory of a detector whose constructor takes its calibration and a struct of options with a
/// parameter table. The table must outlive the factory.
template <typename DetectorType, typename Calibration, typename Options>
DetectorFactory FactoryFor(const ParameterTable<Options>& table) {
  return [&table](const SensorCalibration& calibration, const OptionValues& values) {
    Options options;
    for (const auto& [name, value] : values) table.Set(options, name, value);
    return std::make_unique<DetectorType>(std::get<Calibration>(calibration), options);
  };
}

}  // namespace fenestra
