#include "experiments/versions.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <pcl/pcl_config.h>
#include <sqlite3.h>
#include <unistd.h>

#include <Eigen/Core>
#include <fstream>
#include <opencv2/core/utility.hpp>
#include <openturns/PlatformInfo.hxx>

#include "experiments/shell_quoting.h"
#include "renderers/embree_version.h"

namespace fenestra {
namespace {

// The note that --build-id leaves in the program itself, which is the first object of all.
int ReadBuildId(dl_phdr_info* object, size_t, void* result) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    // Notes lie in memory one after the other, each padded to four bytes.
    const auto pad = [](size_t bytes) { return (bytes + 3) / 4 * 4; };
    size_t at = object->dlpi_addr + segment.p_vaddr;
    const size_t end = at + segment.p_memsz;
    while (at + sizeof(ElfW(Nhdr)) <= end) {
      const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(at);
      const auto* bytes =
          reinterpret_cast<const unsigned char*>(at + sizeof(*note) + pad(note->n_namesz));
      if (note->n_type == NT_GNU_BUILD_ID) {
        auto& id = *static_cast<std::string*>(result);
        for (size_t k = 0; k < note->n_descsz; ++k) id += fmt::format("{:02x}", bytes[k]);
        return 1;
      }
      at += sizeof(*note) + pad(note->n_namesz) + pad(note->n_descsz);
    }
  }
  return 1;
}

}  // namespace

const std::string& BuildId() {
  static const std::string id = [] {
    std::string found;
    dl_iterate_phdr(ReadBuildId, &found);
    return found;
  }();
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
