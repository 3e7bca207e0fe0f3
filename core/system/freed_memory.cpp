#include "core/system/freed_memory.h"

#include <cstdlib>  // Defines __GLIBC__.

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace fenestra {

void KeepFreedMemory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // The largest that it takes.
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

}  // namespace fenestra
