#include <memory>

#include "experiments/cli/commands.h"
#include "experiments/cli/plugins.h"
#include "experiments/cli/print_result.h"
#include "experiments/run/merge.h"

namespace fenestra::cli {

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
