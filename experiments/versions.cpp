#include "experiments/versions.h"

#include <fmt/format.h>
#include <pcl/pcl_config.h>
#include <sqlite3.h>
#include <unistd.h>

#include <Eigen/Core>
#include <fstream>
#include <opencv2/core/utility.hpp>
#include <openturns/PlatformInfo.hxx>

#include "core/build_id.h"
#include "experiments/shell_quoting.h"
#include "renderers/embree_version.h"

namespace fenestra {

const std::string& BuildId() {
  static const std::string id = BuildIdAt(reinterpret_cast<const void*>(&Version));
  return id;
}

const char* Version() {
  return FENESTRA_VERSION;
}

std::string LibraryVersions() {
  return fmt::format("Embree {}, OpenCV {}, PCL {}, Eigen {}.{}.{}, SQLite {}, OpenTURNS {}",
                     EmbreeVersion(), cv::getVersionString(), PCL_VERSION_PRETTY,
                     EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
                     sqlite3_libversion(), OT::PlatformInfo::GetVersion());
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
