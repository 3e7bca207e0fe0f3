#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <opencv2/core/version.hpp>
#include <string>

#include "core/detection/detector.h"
#include "core/geometry/calibration.h"
#include "core/io/parameter_table.h"
#include "vision/detector_info.h"

/// Detectors in shared libraries. A library that calls, once, outside of any function,
///
///     FENESTRA_DETECTOR_PLUGIN(Register)
///
/// with a function of the form
///
///     void Register(fenestra::DetectorRegistrar& registrar);
///
/// can be loaded with --plugin; examples/plugin is a complete one. It must be built with the same
/// compiler, headers and libraries as the program, because C++ objects are exchanged.
/// PluginInterface() states which these were, and a library with a different interface is refused.

namespace fenestra {

/// Registers a plugin's detectors.
class DetectorRegistrar {
 public:
  virtual ~DetectorRegistrar() = default;
  /// The name must be 1 to 64 of the characters a-z 0-9 _ - and must not be taken.
  virtual void Add(const DetectorInfo& info, const DetectorFactory& make) = 0;
};

/// Incremented with every change to the types shared by plugins and the program that does not
/// change the sizes below.
inline constexpr int kPluginInterfaceVersion = 1;

/// Text of everything that must be equal on both sides.
inline std::string PluginInterface() {
  const auto sizes = [](auto... size) { return (std::to_string(size) + ...); };
  return "Fenestra plugin interface " + std::to_string(kPluginInterfaceVersion) + ", compiler " +
         __VERSION__ + ", C++ ABI " + std::to_string(__GXX_ABI_VERSION) + ", string ABI " +
         std::to_string(_GLIBCXX_USE_CXX11_ABI) + ", Eigen " + std::to_string(EIGEN_WORLD_VERSION) +
         "." + std::to_string(EIGEN_MAJOR_VERSION) + "." + std::to_string(EIGEN_MINOR_VERSION) +
         " aligned to " + std::to_string(EIGEN_MAX_ALIGN_BYTES) + ", OpenCV " + CV_VERSION +
         ", sizes " +
         sizes(sizeof(WindowEstimate), sizeof(Miss), sizeof(Observation), sizeof(SensorCalibration),
               sizeof(StageLog), sizeof(DetectorInfo), sizeof(ParameterInfo));
}

}  // namespace fenestra

#define FENESTRA_DETECTOR_PLUGIN(register_function)                                           \
  extern "C" __attribute__((visibility("default"))) const char* fenestra_plugin_interface() { \
    static const std::string text = ::fenestra::PluginInterface();                            \
    return text.c_str();                                                                      \
  }                                                                                           \
  extern "C" __attribute__((visibility("default"))) void fenestra_plugin_register(            \
      ::fenestra::DetectorRegistrar& registrar) {                                             \
    register_function(registrar);                                                             \
  }
