#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/calibration.h"
#include "core/check.h"
#include "core/detector.h"
#include "core/parameter_table.h"

namespace fenestra {

/// A detector that can be asked for by name.
struct DetectorInfo {
  std::string name;  ///< "paper-stereo"
  SensorKind sensor;
  std::string description;  ///< One line.
  std::vector<ParameterInfo> options;
  /// Whether it runs in a process of its own unless a study says otherwise: true for plugins.
  bool isolate = false;
};

using OptionValues = std::map<std::string, ParameterValue>;

/// Makes a detector; the calibration is of its sensor, the options are allowed. Throws InputError
/// for options that contradict each other.
using DetectorFactory =
    std::function<std::unique_ptr<Detector>(const SensorCalibration&, const OptionValues&)>;

/// Of a detector that is built from its calibration and a struct of options with a table. The table
/// must outlive the factory.
template <typename DetectorType, typename Calibration, typename Options>
DetectorFactory FactoryFor(const ParameterTable<Options>& table) {
  return [&table](const SensorCalibration& calibration, const OptionValues& values) {
    Options options;
    for (const auto& [name, value] : values) table.Set(options, name, value);
    return std::make_unique<DetectorType>(std::get<Calibration>(calibration), options);
  };
}

}  // namespace fenestra
