#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "core/io/input_error.h"
#include "core/io/temporary_files.h"
#include "core/system/program.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/detector_arguments.h"
#include "experiments/cli/study_run_arguments.h"
#include "experiments/run/shards.h"
#include "experiments/study_file/study_catalogue.h"

namespace fenestra::cli {
namespace {

namespace fs = std::filesystem;

struct SubmitArguments {
  std::string study;
  bool slurm = false;
  int shards = 1;
  StudyRunArguments run{.jobs = 1};
  std::vector<std::string> sbatch_options;
  bool dry_run = false;
};

SlurmSubmission SubmissionOf(const SubmitArguments& arguments, const std::string& name) {
  SlurmSubmission submission{.program = fs::read_symlink("/proc/self/exe"),
                             .study = {},
                             .name = name,
                             .run_options = {},
                             .sbatch_options = arguments.sbatch_options,
                             .out = arguments.run.out,
                             .shards = arguments.shards,
                             .jobs = arguments.run.jobs};
  if (submission.out.empty()) submission.out = fs::path("results") / name;
  submission.out = fs::absolute(submission.out).lexically_normal();
  submission.study = submission.out / "slurm" / "study.yaml";
  const StudyRunArguments& run = arguments.run;
  if (run.seed) submission.run_options.push_back(fmt::format("--seed={}", *run.seed));
  if (run.trials) submission.run_options.push_back(fmt::format("--trials={}", *run.trials));
  for (const fs::path& plugin : run.plugins) submission.plugins.push_back(fs::absolute(plugin));
  return submission;
}

// Runs sbatch and returns the number of the job.
std::string Submit(const std::string& options, const fs::path& script) {
  const std::string command =
      fmt::format("sbatch --parsable {} {}", options, ShellQuoted(script.string()));
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("no process can be started for sbatch");
  std::string answer;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) answer += static_cast<char>(c);
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    throw InputError("sbatch", "is not on this machine; --dry-run shows what would be submitted");
  }
  const std::string job = answer.substr(0, answer.find_first_of(";\n"));
  if (status != 0 || job.empty()) throw std::runtime_error("sbatch failed: " + command);
  return job;
}

void Submit(const SubmitArguments& arguments) {
  if (!arguments.slurm) throw InputError("submit", "say where to: --slurm");
  const StudyRun run = MakeStudyRun(FindStudy(arguments.study), arguments.run);
  const SlurmSubmission submission = SubmissionOf(arguments, run.study.name);
  const fs::path folder = submission.out / "slurm";
  constexpr const char* kDependent = "--kill-on-invalid-dep=yes --dependency=afterok:";
  if (arguments.dry_run) {
    fmt::print("# {}\n{}\n# {}\n{}\n# sbatch {}\n# sbatch {}ARRAY {}\n",
               (folder / "array.sh").string(), SlurmArrayScript(submission),
               (folder / "merge.sh").string(), SlurmMergeScript(submission),
               (folder / "array.sh").string(), kDependent, (folder / "merge.sh").string());
    return;
  }
  const OutputPath scripts = OutputPath::Folder(folder);
  WriteFileAtomically(scripts / submission.study.filename(), run.study_text);
  WriteFileAtomically(scripts / "array.sh", SlurmArrayScript(submission));
  WriteFileAtomically(scripts / "merge.sh", SlurmMergeScript(submission));
  const std::string array = Submit("", folder / "array.sh");
  const std::string merge = Submit(kDependent + array, folder / "merge.sh");
  fmt::print("Submitted: array {} of {} shards, then merge {}. The result will be in {}\n", array,
             submission.shards, merge, submission.out.string());
}

}  // namespace

void AddSubmitCommand(Command program) {
  Command command = program.AddCommand("submit", "Shares a study out over a cluster");
  command.Footer(
      "Example:\n"
      "  fenestra submit paper --slurm --shards 20 --out /shared/paper --sbatch=--time=1:00:00\n"
      "Submits a job array with a shard per task, and a job that merges them. All nodes must see\n"
      "this program and DIR. Submitted again, it goes on from what is stored in DIR/shards.");
  const auto arguments = std::make_shared<SubmitArguments>();
  command.AddOption("STUDY", arguments->study, "Name or file of a study").Required();
  command.AddFlag("--slurm", arguments->slurm, "To Slurm, with sbatch");
  command.AddOption("--shards", arguments->shards, "Into how many tasks the study is divided")
      .Required()
      .Within(1, 100000);
  AddStudyRunOptions(command, arguments->run);
  command.FindOption("--jobs").Describe("Trials at the same time in each task; default: 1");
  command
      .AddOption("--sbatch", arguments->sbatch_options,
                 "A further option for both jobs, such as --sbatch=--partition=long")
      .OneValueEach();
  command.AddFlag("--dry-run", arguments->dry_run, "Prints what it would submit");
  command.Action([arguments] {
    Submit(*arguments);
    return kDone;
  });
}

void AddMergeCommand(Command program) {
  Command command = program.AddCommand("merge", "Joins the shards of a study");
  command.Footer(
      "Example:\n"
      "  fenestra run paper --shard 1/2 --out a      on one machine\n"
      "  fenestra run paper --shard 2/2 --out b      on another one\n"
      "  fenestra merge a b --out results/paper\n"
      "Shards that are missing, incomplete, there twice or of another study are refused.");
  const auto merge = std::make_shared<Merge>();
  command.AddOption("SHARDS", merge->shards, "Results folders of all shards").Required();
  command.AddOption("--out", merge->out, "Results folder of the whole").Required();
  command.AddFlag("--restart", merge->restart, "Replaces another result that is there");
  const auto plugins = std::make_shared<std::vector<std::filesystem::path>>();
  AddPluginOption(command, *plugins);
  command.Action([merge, plugins] {
    LoadPlugins(*plugins);
    PrintResult(MergeShards(*merge), merge->out);
    return kDone;
  });
}

}  // namespace fenestra::cli
