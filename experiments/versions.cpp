#include "experiments/versions.h"

#include <fmt/format.h>
#include <pcl/pcl_config.h>
#include <sqlite3.h>

#include <Eigen/Core>
#include <fstream>
#include <opencv2/core/utility.hpp>

#include "renderers/embree_version.h"

namespace fenestra {

const char* Version() {
  return FENESTRA_VERSION;
}

std::string LibraryVersions() {
  return fmt::format("Embree {}, OpenCV {}, PCL {}, Eigen {}.{}.{}, SQLite {}", EmbreeVersion(),
                     cv::getVersionString(), PCL_VERSION_PRETTY, EIGEN_WORLD_VERSION,
                     EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, sqlite3_libversion());
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
  const char* widest = __builtin_cpu_supports("avx512f") ? "AVX-512"
                       : __builtin_cpu_supports("avx2")  ? "AVX2"
                                                         : "SSE";
  return name + ", " + widest;
}

}  // namespace fenestra
