#include <unistd.h>

#include <fmt/format.h>
#include <ext/stdio_filebuf.h>

#include <iostream>

#include "core/io/faults.h"
#include "core/io/input_error.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "vision/detector_registry.h"
#include "vision/external/detector_server.h"

namespace fenestra::cli {
namespace {

struct ServeArguments {
  std::string detector;
  std::vector<std::filesystem::path> plugins;
};

std::string Objection(const DetectorInfo& info, const Hello& hello) {
  if (hello.sensor != info.sensor) {
    return fmt::format("{} works on {}, not on {}", info.name, ToString(info.sensor),
                       ToString(hello.sensor));
  }
  for (const auto& [name, value] : hello.options) {
    const auto option = std::find_if(info.options.begin(), info.options.end(),
                                     [&key = name](const auto& o) { return o.name == key; });
    if (option == info.options.end()) return fmt::format("{} has no option {}", info.name, name);
    if (const auto objection = option->Objection(value)) return *objection;
  }
  return "";
}

void Serve(const ServeArguments& arguments) {
  LoadPlugins(arguments.plugins);
  const DetectorInfo* info = FindDetector(arguments.detector);
  if (info == nullptr) {
    std::vector<std::string> names;
    for (const DetectorInfo& detector : Detectors()) names.push_back(detector.name);
    throw InputError("DETECTOR", fmt::format("there is no detector '{}'.{}", arguments.detector,
                                             DidYouMean(arguments.detector, names)));
  }
  // What a detector prints must not stand among the answers.
  __gnu_cxx::stdio_filebuf<char> answers(dup(STDOUT_FILENO), std::ios::out);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  std::ostream out(&answers);
  const ServedDetector served{
      .objection = [info](const Hello& hello) { return Objection(*info, hello); },
      .make =
          [info](const Hello& hello, const SensorCalibration& calibration) {
            return MakeDetector(info->name, calibration, hello.options);
          }};
  ServeDetector(served, std::cin, out);
}

}  // namespace

void AddServeCommand(Command program) {
  Command command =
      program.AddCommand("serve", "Answers requests for a detector on standard input and output");
  command.Footer(
      "Example:\n"
      "  fenestra serve edge-stereo --plugin libmine.so\n"
      "This is the other end of a detector with `command:` or `isolate: true` in a study; see\n"
      "docs/own_detectors.md for what is said.");
  const auto arguments = std::make_shared<ServeArguments>();
  command.AddOption("DETECTOR", arguments->detector, "Name of the detector").Required();
  AddPluginOption(command, arguments->plugins);
  command.Action([arguments] {
    Serve(*arguments);
    return kDone;
  });
}

}  // namespace fenestra::cli
