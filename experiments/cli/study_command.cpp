#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "core/io/temporary_files.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/cli/study_run_arguments.h"
#include "experiments/run/study_explanation.h"
#include "experiments/study_file/study_catalogue.h"
#include "experiments/study_file/study_reader.h"
#include "experiments/study_file/study_schema.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

struct StudyCheckArguments {
  std::string study;
  std::vector<std::filesystem::path> plugins;
};

struct ExplainArguments {
  std::string study;
  StudyRunArguments run;
  int probes = 1;
};

void Check(const StudyCheckArguments& arguments) {
  LoadPlugins(arguments.plugins);
  const Study study = ReadStudyFile(FindStudy(arguments.study), Detectors());
  fmt::print("'{}' is sound: {} cells, {} trials.\n", study.name, CountCells(study),
             CountTrials(study));
}

void Explain(const ExplainArguments& arguments) {
  const StudyRun run = MakeStudyRun(FindStudy(arguments.study), arguments.run);
  fmt::print("{}",
             ExplanationText(run.study, ExplainStudy(run.study, arguments.probes, run.detectors),
                             run.jobs));
}

void AddExplain(Command study) {
  Command explain = study.AddCommand(
      "explain", "Shows what a study would run, how long it would take and how large it would be");
  explain.Footer(
      "Example:\n"
      "  fenestra study explain paper --probe 3 --jobs 8\n"
      "Times are measured on this machine, by running trials of the first and the last cell of "
      "each "
      "part and sensor.");
  const auto arguments = std::make_shared<ExplainArguments>();
  explain.AddOption("STUDY", arguments->study, "Name or file of a study").Required();
  explain
      .AddOption("--probe", arguments->probes,
                 "Trials to run of each of these cells; 0: none, and no times")
      .Within(0, 1000)
      .ShowDefault();
  AddJobsOption(explain, arguments->run.jobs);
  AddStudyOptions(explain, arguments->run);
  explain.Action([arguments] {
    Explain(*arguments);
    return kDone;
  });
}

}  // namespace

void AddStudyCommand(Command program) {
  Command study = program.AddCommand("study", "Checks and explains study files");
  study.RequireCommand();
  study.Footer(
      "Example:\n"
      "  fenestra study check my_study.yaml");

  Command check = study.AddCommand("check", "Reports every fault of a study file");
  check.Footer(
      "Example:\n"
      "  fenestra study check my_study.yaml\n"
      "Exit codes: 0 sound, 2 faulty; each fault has its line and column.");
  const auto arguments = std::make_shared<StudyCheckArguments>();
  check.AddOption("STUDY", arguments->study, "Name or file of a study").Required();
  AddPluginOption(check, arguments->plugins);
  check.Action([arguments] {
    Check(*arguments);
    return kDone;
  });

  AddExplain(study);

  Command schema = study.AddCommand("schema", "Prints a JSON Schema of study files, for editors");
  schema.Footer(
      "Example:\n"
      "  fenestra study schema --out study.schema.json\n"
      "Editors with the YAML language server use it where a study's first line is\n"
      "  # yaml-language-server: $schema=study.schema.json");
  const auto out = std::make_shared<std::filesystem::path>();
  schema.AddOption("--out", *out, "File to write instead of printing");
  const auto plugins = std::make_shared<std::vector<std::filesystem::path>>();
  AddPluginOption(schema, *plugins);
  schema.Action([out, plugins] {
    LoadPlugins(*plugins);
    const std::string text = StudySchema(Detectors());
    if (out->empty()) {
      fmt::print("{}", text);
    } else {
      WriteFileAtomically(*out, text);
    }
    return kDone;
  });
}

}  // namespace fenestra::cli
