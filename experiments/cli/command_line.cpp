#include "experiments/cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "core/detection/observation.h"
#include "core/io/faults.h"
#include "scenes/lighting.h"

namespace fenestra::cli {
namespace {

// CLI11's own validator names the largest double in its message.
std::string FaultUnlessPositive(const std::string& text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  const bool is_number = read.ec == std::errc() && read.ptr == end;
  if (is_number && std::isfinite(value) && value > 0.0) return {};
  return fmt::format("'{}' is not a positive number", text);
}

// CLI11 takes a word in brackets for a list wherever several values may stand, so that a folder
// '[L]' would be L. A byte in front of the bracket hides it until the values are read.
constexpr char kHidesBracket = '\x1f';

// The words of the command line in the order in which CLI11 takes them, the last one first.
std::vector<std::string> HiddenBrackets(int argc, char** argv) {
  std::vector<std::string> words;
  for (int i = argc - 1; i > 0; --i) {
    std::string& word = words.emplace_back(argv[i]);
    const size_t value = word.starts_with("--") ? word.find('=') + 1 : 0;  // npos + 1 is 0
    if (word.substr(value).starts_with('[')) word.insert(value, 1, kHidesBracket);
  }
  return words;
}

std::string WithBrackets(std::string text) {
  std::erase(text, kHidesBracket);
  return text;
}

CLI::Option* ShowingBrackets(CLI::Option* option) {
  return option->transform(CLI::Validator(
      [](std::string& text) {
        text = WithBrackets(text);
        return std::string();
      },
      ""));
}

// The innermost command that was named on the command line.
const CLI::App* Innermost(const CLI::App* app) {
  const auto named = app->get_subcommands();
  return named.empty() ? app : Innermost(named.front());
}

std::vector<std::string> KnownFlags(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  }
  return flags;
}

std::vector<std::string> KnownCommands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

// What is wrong with the command line, with a hint for every word that is unknown.
int ReportParseError(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App* app = Innermost(&program);
  const std::vector<std::string> unknown = program.remaining(true);
  const auto is_flag = [](const std::string& word) { return word.starts_with("-"); };
  const bool flags = std::any_of(unknown.begin(), unknown.end(), is_flag);
  for (const std::string& hidden : unknown) {
    const std::string word = WithBrackets(hidden);
    const bool flag = is_flag(word);
    if (flags && !flag) continue;  // Most likely the value of an unknown option.
    const std::vector<std::string> known = flag ? KnownFlags(*app) : KnownCommands(*app);
    const std::string name = word.substr(0, word.find('='));
    Tell(fmt::format("{}: unknown {} '{}'.{}", program.get_name(), flag ? "option" : "argument",
                     word, DidYouMean(name, known)));
  }
  if (unknown.empty()) Tell(fmt::format("{}: {}", program.get_name(), error.what()));
  std::string command = program.get_name();
  for (const CLI::App* at = &program; at != app;) {
    at = at->get_subcommands().front();
    command += " " + at->get_name();
  }
  Tell(fmt::format("See '{} --help'.", command));
  return kInputError;
}

}  // namespace

void Tell(const std::string& line) {
  std::fputs((line + "\n").c_str(), stderr);
}

Option Option::Required() {
  return Option(option_->required());
}
Option Option::ShowDefault() {
  return Option(option_->capture_default_str());
}
Option Option::Describe(const std::string& help) {
  return Option(option_->description(help));
}
Option Option::Group(const std::string& heading) {
  return Option(option_->group(heading));
}
Option Option::TypeName(const std::string& name) {
  return Option(option_->type_name(name));
}
Option Option::Within(int least, int most) {
  return Option(option_->check(CLI::Range(least, most)));
}
Option Option::Within(uint64_t least, uint64_t most) {
  return Option(option_->check(CLI::Range(least, most)));
}
Option Option::Positive() {
  return Option(option_->check(CLI::Validator(FaultUnlessPositive, "POSITIVE")));
}
Option Option::OneOf(const std::vector<std::string>& words) {
  return Option(option_->check(CLI::IsMember(words)));
}
Option Option::Excludes(Option other) {
  return Option(option_->excludes(other.option_));
}
Option Option::Delimiter(char between) {
  return Option(option_->delimiter(between));
}
Option Option::OneValueEach() {
  return Option(option_->allow_extra_args(false));
}

Command Command::AddCommand(const std::string& name, const std::string& description) {
  return {app_->add_subcommand(name, description), exit_code_};
}

void Command::RequireCommand() {
  app_->require_subcommand(1);
}

void Command::Footer(const std::string& text) {
  app_->footer(text);
}

template <class Value>
Option Command::AddOption(const std::string& name, Value& value, const std::string& help) {
  return Option(ShowingBrackets(app_->add_option(name, value, help)));
}

template <class Value, class Choice>
Option Command::AddChoice(const std::string& name, Value& value,
                          const std::map<std::string, Choice>& choices, const std::string& help) {
  return Option(ShowingBrackets(
      app_->add_option(name, value, help)->transform(CLI::CheckedTransformer(choices))));
}

Option Command::AddFlag(const std::string& name, bool& value, const std::string& help) {
  return Option(app_->add_flag(name, value, help));
}

Option Command::FindOption(const std::string& name) {
  return Option(app_->get_option(name));
}

std::vector<std::string> Command::GivenOptions() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : app_->get_options()) {
    if (option->get_lnames().empty() || option->count() == 0) continue;
    names.push_back(option->get_name());
  }
  return names;
}

void Command::Action(std::function<int()> action) {
  app_->callback([action = std::move(action), exit_code = exit_code_] { *exit_code = action(); });
}

CommandLineParser::CommandLineParser(const std::string& program, const std::string& description)
    : app_(std::make_unique<CLI::App>(description, program)) {}

CommandLineParser::~CommandLineParser() = default;

Command CommandLineParser::program() {
  return {app_.get(), &exit_code_};
}

void CommandLineParser::SetVersion(std::function<std::string()> version) {
  app_->set_version_flag("--version", std::move(version));
}

int CommandLineParser::Run(int argc, char** argv) {
  try {
    app_->parse(HiddenBrackets(argc, argv));
  } catch (const CLI::ParseError& error) {
    const bool asks_for_help = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    if (asks_for_help && app_->remaining(true).empty()) {
      return app_->exit(error);  // --help, --version
    }
    return ReportParseError(*app_, error);
  }
  return exit_code_;
}

// What options may be of: numbers, texts, paths, each of them perhaps absent, and lists.
#define FENESTRA_OPTION_OF(...) \
  template Option Command::AddOption(const std::string&, __VA_ARGS__&, const std::string&)
FENESTRA_OPTION_OF(int);
FENESTRA_OPTION_OF(uint64_t);
FENESTRA_OPTION_OF(double);
FENESTRA_OPTION_OF(std::string);
FENESTRA_OPTION_OF(std::filesystem::path);
FENESTRA_OPTION_OF(std::optional<int>);
FENESTRA_OPTION_OF(std::optional<uint64_t>);
FENESTRA_OPTION_OF(std::optional<double>);
FENESTRA_OPTION_OF(std::optional<std::string>);
FENESTRA_OPTION_OF(std::vector<std::string>);
FENESTRA_OPTION_OF(std::vector<std::filesystem::path>);
#undef FENESTRA_OPTION_OF

// NOLINTBEGIN(bugprone-macro-parentheses): a type cannot stand in parentheses.
#define FENESTRA_CHOICE_OF(Value, Choice)                        \
  template Option Command::AddChoice(const std::string&, Value&, \
                                     const std::map<std::string, Choice>&, const std::string&)
FENESTRA_CHOICE_OF(Sky::Model, Sky::Model);
FENESTRA_CHOICE_OF(std::optional<SensorKind>, SensorKind);
#undef FENESTRA_CHOICE_OF
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fenestra::cli
