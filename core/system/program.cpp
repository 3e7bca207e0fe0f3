#include "core/system/program.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <unistd.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <span>

namespace fenestra {
namespace {

struct Search {
  uintptr_t address;
  std::string id;
};

bool Holds(const dl_phdr_info& object, uintptr_t address) {
  for (int i = 0; i < object.dlpi_phnum; ++i) {
    const auto& segment = object.dlpi_phdr[i];
    const uintptr_t begin = object.dlpi_addr + segment.p_vaddr;
    if (segment.p_type != PT_LOAD || address < begin) continue;
    if (address < begin + segment.p_memsz) return true;
  }
  return false;
}

// Notes lie in memory one after the other, each padded to four bytes.
std::string IdAmongNotes(std::span<const unsigned char> notes) {
  const auto pad = [](size_t bytes) { return (bytes + 3) / 4 * 4; };
  while (sizeof(ElfW(Nhdr)) <= notes.size()) {
    const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(notes.data());
    const unsigned char* bytes = notes.data() + sizeof(*note) + pad(note->n_namesz);
    if (note->n_type == NT_GNU_BUILD_ID) {
      std::string id;
      for (size_t k = 0; k < note->n_descsz; ++k) id += fmt::format("{:02x}", bytes[k]);
      return id;
    }
    const size_t size = sizeof(*note) + pad(note->n_namesz) + pad(note->n_descsz);
    notes = notes.subspan(std::min(size, notes.size()));
  }
  return {};
}

int Visit(dl_phdr_info* object, size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  if (!Holds(*object, search.address)) return 0;
  for (int i = 0; i < object->dlpi_phnum && search.id.empty(); ++i) {
    const auto& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader tells an address.
    const auto* begin = reinterpret_cast<const unsigned char*>(object->dlpi_addr + segment.p_vaddr);
    search.id = IdAmongNotes({begin, segment.p_memsz});
  }
  return 1;
}

}  // namespace

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
  return name + ", " + WidestInstructionSet();
}

std::string WidestInstructionSet() {
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
    if (!command.empty()) command += ' ';
    command += ShellQuoted(word);
  }
  return command;
}

std::string BuildIdAt(const void* address) {
  Search search{.address = reinterpret_cast<uintptr_t>(address), .id = {}};
  dl_iterate_phdr(Visit, &search);
  return search.id;
}

std::string ShellQuoted(const std::string& word) {
  constexpr const char* kSafe =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=,+%@";
  if (!word.empty() && word.find_first_not_of(kSafe) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  quoted += '\'';
  return quoted;
}

void KeepFreedMemory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // The largest that it takes.
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

}  // namespace fenestra
