// A plugin for tests; PLUGIN_FAULT says what is wrong with it, if anything.

#include <chrono>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "vision/detector_plugin.h"

namespace {

using namespace fenestra;

struct Options {
  std::string mode = "window";
  double depth_m = 1.5;
};

const ParameterTable<Options>& Parameters() {
  static const ParameterTable<Options> table = [] {
    ParameterTable<Options> t;
    t.Choice("mode", FENESTRA_FIELD(mode), {"window", "segfault", "hang", "throw", "print"},
             "What it does");
    t.Number("depth_m", FENESTRA_FIELD(depth_m), {0.1, 100.0}, "Where it sees a window");
    return t;
  }();
  return table;
}

// Sees a window straight ahead in every observation, or does as `mode` says.
class TestDetector : public Detector {
 public:
  TestDetector(const StereoCalibration&, Options options) : options_(std::move(options)) {}

  SensorKind sensor() const override { return SensorKind::kStereo; }

  Detection Detect(const Observation&, StageLog& log) const override {
    log.Begin("look");
    if (options_.mode == "segfault") {
      std::signal(SIGSEGV, SIG_DFL);  // Sanitizers handle it otherwise.
      raise(SIGSEGV);
    }
    if (options_.mode == "hang") std::this_thread::sleep_for(std::chrono::hours(1));
    if (options_.mode == "throw") throw std::runtime_error("as it was told");
    if (options_.mode == "print") printf("a line that is no answer\n");
    const double z = options_.depth_m;
    WindowEstimate estimate;
    estimate.p_CO = {0.0, 0.0, z};
    estimate.p_CV = {Eigen::Vector3d(-0.5, -0.5, z), {0.5, -0.5, z}, {0.5, 0.5, z}, {-0.5, 0.5, z}};
    return estimate;
  }

 private:
  Options options_;
};

[[maybe_unused]] void Register(DetectorRegistrar& registrar) {
  const std::string fault = PLUGIN_FAULT;
  if (fault == "throws") throw std::runtime_error("no licence");
  if (fault == "registers_nothing") return;
  std::string name = "test-detector";
  if (fault == "taken_name") name = "paper-stereo";
  if (fault == "no_name") name = "My Detector";
  registrar.Add({.name = name,
                 .sensor = SensorKind::kStereo,
                 .description = "For tests",
                 .options = Parameters().infos()},
                FactoryFor<TestDetector, StereoCalibration>(Parameters()));
}

}  // namespace

#if defined(PLUGIN_OF_ANOTHER_BUILD)
extern "C" const char* fenestra_plugin_interface() {
  return "Fenestra plugin interface 0, compiler 1.2.3";
}
extern "C" void fenestra_plugin_register(fenestra::DetectorRegistrar&) {}
#elif !defined(PLUGIN_WITHOUT_SYMBOLS)
FENESTRA_DETECTOR_PLUGIN(Register)
#endif
