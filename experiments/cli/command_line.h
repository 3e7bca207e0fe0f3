#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace fenestra::cli {

/// Exit codes of the program.
enum ExitCode : int {
  kDone = 0,
  kLimitViolated = 1,
  kInputError = 2,
  kFailure = 3,
};

// CLI11 behind an interface of what the commands need of it: its headers take more time to compile
// than all commands together, so that command_line.cpp alone includes them.

/// Writes a line for people to standard error. If it cannot be written it is lost: no command fails
/// for want of a reader.
void Tell(const std::string& line);

/// An option or a positional argument of a command. A handle; the command line owns what it is of.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option Required();
  /// The help names the variable's present value as the default.
  Option ShowDefault();
  Option Describe(const std::string& help);
  /// The heading in the help under which it stands.
  Option Group(const std::string& heading);
  /// The word for its value in the help.
  Option TypeName(const std::string& name);

  /// Accepts values from `least` to `most`.
  Option Within(int least, int most);
  Option Within(uint64_t least, uint64_t most);
  /// Accepts finite numbers above 0.
  Option Positive();
  Option OneOf(const std::vector<std::string>& words);
  /// May not be given together with `other`.
  Option Excludes(Option other);
  /// For a list: several values in one word, with this character between them.
  Option Delimiter(char between);
  /// For a list: one value after each mention of the option, which may be given several times.
  Option OneValueEach();

 private:
  CLI::Option* option_;
};

/// A command of the program, or the program itself. A handle, too.
class Command {
 public:
  Command(CLI::App* app, int* exit_code) : app_(app), exit_code_(exit_code) {}

  Command AddCommand(const std::string& name, const std::string& description);
  /// One of its commands has to be named.
  void RequireCommand();
  /// Text below the help.
  void Footer(const std::string& text);

  /// Parsing sets `value`, which lives as long as the command line. A name with dashes makes an
  /// option, one without a positional argument. command_line.cpp lists the possible types.
  template <class Value>
  Option AddOption(const std::string& name, Value& value, const std::string& help);
  /// An option whose values are words that stand for `Choice`s.
  template <class Value, class Choice>
  Option AddChoice(const std::string& name, Value& value,
                   const std::map<std::string, Choice>& choices, const std::string& help);
  Option AddFlag(const std::string& name, bool& value, const std::string& help);
  /// One that was added before.
  Option FindOption(const std::string& name);

  /// Names of the options that the user gave, positional arguments aside.
  std::vector<std::string> GivenOptions() const;

  /// Is called when the command line has been parsed and names this command; returns the program's
  /// exit code.
  void Action(std::function<int()> action);

 private:
  CLI::App* app_;
  int* exit_code_;
};

/// The command line of a program with commands.
class CommandLineParser {
 public:
  CommandLineParser(const std::string& program, const std::string& description);
  ~CommandLineParser();
  CommandLineParser(const CommandLineParser&) = delete;
  CommandLineParser& operator=(const CommandLineParser&) = delete;

  Command program();
  /// --version
  void SetVersion(std::function<std::string()> version);

  /// Parses, calls the action of the command that is named and returns its exit code. What is wrong
  /// with the command line is printed, with a hint for every unknown word, and returns kInputError.
  /// Lets exceptions of the action pass.
  int Run(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
  int exit_code_ = kDone;
};

}  // namespace fenestra::cli
