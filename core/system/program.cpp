#include "core/system/program.h"

#include <unistd.h>

#include <fstream>

#include "core/system/build_id.h"
#include "core/system/shell_quoting.h"

namespace fenestra {

const std::string& BuildId() {
  static const std::string id = BuildIdAt(reinterpret_cast<const void*>(&Version));
  return id;
}

const char* Version() {
  return FENESTRA_VERSION;
}

std::string Processor() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  std::string name = "unknown processor";
  for (std::string line; std::getline(cpuinfo, line);) {
    if (line.starts_with("model name")) {
      name = line.substr(line.find(':') + 2);
      break;
    }
  }
  return name + ", " + InstructionSet();
}

std::string InstructionSet() {
  return __builtin_cpu_supports("avx512f") ? "AVX-512"
         : __builtin_cpu_supports("avx2")  ? "AVX2"
                                           : "SSE";
}

std::string HostName() {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

std::string CommandLine() {
  std::ifstream words("/proc/self/cmdline", std::ios::binary);
  std::string command;
  for (std::string word; std::getline(words, word, '\0');) {
    command += (command.empty() ? "" : " ") + ShellQuoted(word);
  }
  return command;
}

}  // namespace fenestra
