#include "render/tools/heap.h"

#include <cstdint>
#include <cstdlib>

#ifdef __GLIBC__ // by the headers above
#include <malloc.h>
#include <sys/mman.h>
#endif

namespace render::tools {

void make_roomy_heap() {
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
  constexpr uintptr_t kHuge = uintptr_t{2} << 20; // of most processors
  constexpr size_t kRoom = 3 * kHuge;
  constexpr int kKept = 1 << 30, kOwnMapping = 1 << 22; // bytes
  mallopt(M_TRIM_THRESHOLD, kKept);
  mallopt(M_MMAP_THRESHOLD, 2 * static_cast<int>(kRoom)); // the room is part of the heap
  void* room = std::malloc(kRoom);
  if (room) {
    const auto begin = reinterpret_cast<uintptr_t>(room);
    const uintptr_t first = (begin + kHuge - 1) / kHuge * kHuge, end = (begin + kRoom) / kHuge * kHuge;
    (void)madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
    std::free(room);
  }
  mallopt(M_MMAP_THRESHOLD, kOwnMapping);
#endif
}

} // namespace render::tools
