#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "core/io/temporary_files.h"
#include "experiments/cli/commands.h"
#include "experiments/validation/validation.h"

namespace fenestra::cli {
namespace {

constexpr char kDocument[] = "validation.md";

struct ValidateArguments {
  validation::ValidationOptions options;
  std::filesystem::path folder;  ///< Empty: the table is only printed.
};

void Validate(const ValidateArguments& arguments) {
  std::optional<OutputPath> out;
  if (!arguments.folder.empty()) {
    out = OutputPath::Folder(arguments.folder);
    out->RequireWritable();
    out->RequireFree({kDocument});
  }
  const std::string document =
      validation::ValidationMarkdown(validation::AllRows(arguments.options));
  if (out) WriteFileAtomically(*out / kDocument, document);
  fmt::print("{}", document);
  if (out) fmt::print("\nIn {}: {}\n", arguments.folder.string(), kDocument);
}

}  // namespace

void AddValidateCommand(Command program) {
  Command command =
      program.AddCommand("validate", "Holds the sensor models against recordings of real sensors");
  command.Footer(
      "Example:\n"
      "  fenestra validate --recordings tests/data --out /tmp/validation\n"
      "One table: what was recorded, what the simulated sensor gives of the same, whether that "
      "was\n"
      "fitted or predicted, and how well the two agree. Takes about a minute. Ends with exit\n"
      "code 0 whatever the verdicts are.");
  const auto arguments = std::make_shared<ValidateArguments>();
  command
      .AddOption("--recordings", arguments->options.recordings,
                 "Folder of recordings, as tests/data")
      .ShowDefault();
  command
      .AddOption("--peers", arguments->options.peers,
                 "What comparisons with other programs said last; need not be there")
      .ShowDefault();
  command.AddOption("--out", arguments->folder, "Folder for validation.md");
  command.Action([arguments] {
    Validate(*arguments);
    return kDone;
  });
}

}  // namespace fenestra::cli
