#include "experiments/run/slurm_scripts.h"

#include <fmt/format.h>

#include "core/system/program.h"

namespace fenestra {
namespace {

// sbatch reads quotes in its directives as a shell does.
std::string Header(const SlurmSubmission& submission, const std::string& log) {
  std::string text = fmt::format(
      "#!/bin/bash\n"
      "#SBATCH --job-name=fenestra-{}\n"
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --output={}\n",
      submission.name, ShellQuoted((submission.out / "slurm" / log).string()));
  for (const std::string& option : submission.sbatch_options) {
    text += fmt::format("#SBATCH {}\n", option);
  }
  return text;
}

std::string PluginOptions(const SlurmSubmission& submission) {
  std::string options;
  for (const std::filesystem::path& plugin : submission.plugins) {
    options += " --plugin " + ShellQuoted(plugin.string());
  }
  return options;
}

}  // namespace

std::string SlurmArrayScript(const SlurmSubmission& submission) {
  std::string text = Header(submission, "shard-%a.log");
  text += fmt::format("#SBATCH --array=1-{}\n#SBATCH --cpus-per-task={}\n", submission.shards,
                      submission.jobs);
  std::string options = PluginOptions(submission);
  for (const std::string& option : submission.run_options) options += " " + ShellQuoted(option);
  return text + fmt::format(
                    "exec {} run {}{} --jobs {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" "
                    "--out {}/\"$SLURM_ARRAY_TASK_ID\"\n",
                    ShellQuoted(submission.program.string()),
                    ShellQuoted(submission.study.string()), options, submission.jobs,
                    submission.shards, ShellQuoted((submission.out / "shards").string()));
}

std::string SlurmMergeScript(const SlurmSubmission& submission) {
  return Header(submission, "merge.log") +
         fmt::format("exec {} merge {}/{{1..{}}} --out {}{}\n",
                     ShellQuoted(submission.program.string()),
                     ShellQuoted((submission.out / "shards").string()), submission.shards,
                     ShellQuoted(submission.out.string()), PluginOptions(submission));
}

}  // namespace fenestra
