#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace fenestra {

struct ProgramOutput {
  int exit_code;
  std::string text;  ///< Standard output and standard error.
};

/// A line of the shell, without input.
inline ProgramOutput Shell(const std::string& line) {
  FILE* pipe = popen(("(" + line + ") 2>&1 </dev/null").c_str(), "r");
  std::string text;
  char buffer[4096];
  while (const size_t count = fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, count);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

/// The program in a process of its own, without input. Arguments are read by the shell.
inline ProgramOutput Fenestra(const std::string& arguments) {
  return Shell(std::string(FENESTRA_PROGRAM) + " " + arguments);
}

}  // namespace fenestra
