#include <memory>

#include "experiments/cli/commands.h"
#include "experiments/cli/plugins.h"
#include "experiments/cli/print_result.h"
#include "experiments/merge.h"

namespace fenestra::cli {

void AddMergeCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("merge", "Joins the shards of a study");
  command->footer(
      "Example:\n"
      "  fenestra run paper --shard 1/2 --out a      on one machine\n"
      "  fenestra run paper --shard 2/2 --out b      on another one\n"
      "  fenestra merge a b --out results/paper\n"
      "Shards that are missing, incomplete, there twice or of another study are refused.");
  const auto merge = std::make_shared<Merge>();
  command->add_option("SHARDS", merge->shards, "Results folders of all shards")->required();
  command->add_option("--out", merge->out, "Results folder of the whole")->required();
  command->add_flag("--restart", merge->restart, "Replaces another result that is there");
  const auto plugins = std::make_shared<std::vector<std::filesystem::path>>();
  AddPluginOption(*command, *plugins);
  command->callback([merge, plugins, &exit_code] {
    LoadPlugins(*plugins);
    PrintResult(MergeShards(*merge), merge->out);
    exit_code = kDone;
  });
}

}  // namespace fenestra::cli
