#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "core/io/input_error.h"
#include "core/io/temporary_files.h"
#include "experiments/check/check_report.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/study_run_arguments.h"
#include "experiments/run/stored_study.h"
#include "experiments/run/result_files.h"
#include "experiments/store/store.h"
#include "experiments/study_file/study_catalogue.h"

namespace fenestra::cli {
namespace {

namespace fs = std::filesystem;

struct CheckArguments {
  fs::path limits;
  fs::path results;
  fs::path baseline;
  StudyRunArguments run;
  fs::path junit;
  fs::path markdown;
  bool strict = false;
};

ResultStore OpenResults(const fs::path& path) {
  return ResultStore::OpenReadOnly(StoreFile(path));
}

// A study that a file of limits names is a built-in one or stands beside it.
fs::path StudyFile(const fs::path& limits, const std::string& study) {
  const fs::path beside = limits.parent_path() / study;
  return fs::is_regular_file(beside) ? beside : FindStudy(study);
}

// Runs the study of the limits; returns the folder of its results.
fs::path Run(const CheckArguments& arguments, const LimitFile& file) {
  if (file.study.empty()) {
    throw InputError(arguments.limits, "names no study to run; give --results DIR");
  }
  const StudyRun run = MakeStudyRun(StudyFile(arguments.limits, file.study), arguments.run);
  if (!RunWithProgress(run).complete()) {
    throw std::runtime_error("interrupted; the same command goes on from there");
  }
  return run.out;
}

int Check(const CheckArguments& arguments) {
  const LimitFile file = ReadLimitFile(YamlReader::FromFile(arguments.limits));
  for (const fs::path& out : {arguments.junit, arguments.markdown}) {
    if (!out.empty()) OutputPath(out).RequireWritable();
  }
  std::vector<TrialRecord> baseline;
  if (!arguments.baseline.empty()) baseline = OpenResults(arguments.baseline).Rows();
  const fs::path results = arguments.results.empty() ? Run(arguments, file) : arguments.results;
  const ResultStore store = OpenResults(results);
  if (const std::string part = PartStored(store, results); !part.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: holds {}; finish the run, or merge all of its shards, before it is checked",
        results.string(), part));
  }
  const CheckResult result =
      CheckLimits(arguments.limits.string(), file, StudyOf(store, results), store.Rows(), baseline);
  fmt::print("{}", CheckForTerminal(result));
  if (!arguments.junit.empty()) {
    WriteFileAtomically(arguments.junit,
                        CheckJunitXml(result, arguments.limits.stem().string(), arguments.strict));
  }
  if (!arguments.markdown.empty()) {
    WriteFileAtomically(arguments.markdown, CheckMarkdown(result));
  }
  const bool fails = result.Count(Verdict::kViolated) > 0 ||
                     (arguments.strict && result.Count(Verdict::kUndecided) > 0);
  return fails ? kLimitViolated : kDone;
}

}  // namespace

void AddCheckCommand(Command program) {
  Command command = program.AddCommand("check", "Holds results against limits, as a CI gate does");
  command.Footer(
      "Examples:\n"
      "  fenestra check limits.yaml                            runs the study that it names\n"
      "  fenestra check limits.yaml --results results/paper\n"
      "  fenestra check limits.yaml --results new --baseline old --markdown comment.md\n"
      "Exit codes: 0 no limit is violated, 1 one is (with --strict: or is undecided), 3 trials are "
      "missing.");
  const auto arguments = std::make_shared<CheckArguments>();
  command.AddOption("LIMITS", arguments->limits, "File of limits (YAML)").Required();
  Option results =
      command.AddOption("--results", arguments->results, "Results to check; else the study is run");
  command.AddOption("--baseline", arguments->baseline,
                    "Results of the same study to compare with, trial by trial");
  for (Option option : AddStudyRunOptions(command, arguments->run)) {
    option.Excludes(results);
  }
  command.AddOption("--junit", arguments->junit, "Write JUnit XML to this file");
  command.AddOption("--markdown", arguments->markdown,
                    "Write a comment for a pull request to this file");
  command.AddFlag("--strict", arguments->strict, "Undecided limits fail, too");
  command.Action([arguments] { return Check(*arguments); });
}

}  // namespace fenestra::cli
