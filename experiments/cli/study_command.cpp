#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "core/atomic_file.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/plugins.h"
#include "experiments/cli/study_run_arguments.h"
#include "experiments/study_catalogue.h"
#include "experiments/study_explanation.h"
#include "experiments/study_reader.h"
#include "experiments/study_schema.h"
#include "vision/detector_registry.h"

namespace fenestra::cli {
namespace {

struct CheckArguments {
  std::string study;
  std::vector<std::filesystem::path> plugins;
};

struct ExplainArguments {
  std::string study;
  StudyRunArguments run;
  int probes = 1;
};

void Check(const CheckArguments& arguments) {
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

void AddExplain(CLI::App& study, int& exit_code) {
  CLI::App* explain = study.add_subcommand(
      "explain", "Shows what a study would run, how long it would take and how large it would be");
  explain->footer(
      "Example:\n"
      "  fenestra study explain paper --probe 3 --jobs 8\n"
      "Times are measured on this machine, by running trials of the first and the last cell of "
      "each "
      "part and sensor.");
  const auto arguments = std::make_shared<ExplainArguments>();
  explain->add_option("STUDY", arguments->study, "Name or file of a study")->required();
  explain
      ->add_option("--probe", arguments->probes,
                   "Trials to run of each of these cells; 0: none, and no times")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  AddJobsOption(*explain, arguments->run.jobs);
  AddStudyOptions(*explain, arguments->run);
  explain->callback([arguments, &exit_code] {
    Explain(*arguments);
    exit_code = kDone;
  });
}

}  // namespace

void AddStudyCommand(CLI::App& program, int& exit_code) {
  CLI::App* study = program.add_subcommand("study", "Checks and explains study files");
  study->require_subcommand(1);
  study->footer(
      "Example:\n"
      "  fenestra study check my_study.yaml");

  CLI::App* check = study->add_subcommand("check", "Reports every fault of a study file");
  check->footer(
      "Example:\n"
      "  fenestra study check my_study.yaml\n"
      "Exit codes: 0 sound, 2 faulty; each fault has its line and column.");
  const auto arguments = std::make_shared<CheckArguments>();
  check->add_option("STUDY", arguments->study, "Name or file of a study")->required();
  AddPluginOption(*check, arguments->plugins);
  check->callback([arguments, &exit_code] {
    Check(*arguments);
    exit_code = kDone;
  });

  AddExplain(*study, exit_code);

  CLI::App* schema =
      study->add_subcommand("schema", "Prints a JSON Schema of study files, for editors");
  schema->footer(
      "Example:\n"
      "  fenestra study schema --out study.schema.json\n"
      "Editors with the YAML language server use it where a study's first line is\n"
      "  # yaml-language-server: $schema=study.schema.json");
  const auto out = std::make_shared<std::filesystem::path>();
  schema->add_option("--out", *out, "File to write instead of printing");
  const auto plugins = std::make_shared<std::vector<std::filesystem::path>>();
  AddPluginOption(*schema, *plugins);
  schema->callback([out, plugins, &exit_code] {
    LoadPlugins(*plugins);
    const std::string text = StudySchema(Detectors());
    if (out->empty()) {
      fmt::print("{}", text);
    } else {
      WriteFileAtomically(*out, text);
    }
    exit_code = kDone;
  });
}

}  // namespace fenestra::cli
