#include "core/system/build_id.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstdint>

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
std::string IdAmongNotes(uintptr_t at, uintptr_t end) {
  const auto pad = [](size_t bytes) { return (bytes + 3) / 4 * 4; };
  while (at + sizeof(ElfW(Nhdr)) <= end) {
    const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(at);
    const auto* bytes =
        reinterpret_cast<const unsigned char*>(at + sizeof(*note) + pad(note->n_namesz));
    if (note->n_type == NT_GNU_BUILD_ID) {
      std::string id;
      for (size_t k = 0; k < note->n_descsz; ++k) id += fmt::format("{:02x}", bytes[k]);
      return id;
    }
    at += sizeof(*note) + pad(note->n_namesz) + pad(note->n_descsz);
  }
  return {};
}

int Visit(dl_phdr_info* object, size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  if (!Holds(*object, search.address)) return 0;
  for (int i = 0; i < object->dlpi_phnum && search.id.empty(); ++i) {
    const auto& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const uintptr_t begin = object->dlpi_addr + segment.p_vaddr;
    search.id = IdAmongNotes(begin, begin + segment.p_memsz);
  }
  return 1;
}

}  // namespace

std::string BuildIdAt(const void* address) {
  Search search{.address = reinterpret_cast<uintptr_t>(address), .id = {}};
  dl_iterate_phdr(Visit, &search);
  return search.id;
}

}  // namespace fenestra
