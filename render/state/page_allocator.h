// Large arrays of zeros: pages come from the system as they are, in huge pages where it has them, and most
// are not touched before somebody writes there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace render {

/// For std::vector of numbers: values without an initialiser are 0.
template <class T> struct PageAllocator {
  static_assert(std::is_arithmetic_v<T>);
  using value_type = T;

  PageAllocator() = default;
  template <class U> PageAllocator(const PageAllocator<U>&) {}

  T* allocate(size_t count) {
    const size_t bytes = count * sizeof(T);
#ifdef __linux__
    if (bytes >= kLarge) return static_cast<T*>(map(bytes));
#endif
    void* at = ::operator new(bytes);
    std::memset(at, 0, bytes);
    return static_cast<T*>(at);
  }

  void deallocate(T* at, size_t count) {
#ifdef __linux__
    if (count * sizeof(T) >= kLarge) {
      munmap(at, count * sizeof(T));
      return;
    }
#endif
    ::operator delete(at);
  }

  template <class U> void construct(U*) {} // 0 as it is
  template <class U, class... Args> void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }

  friend bool operator==(const PageAllocator&, const PageAllocator&) {
    return true;
  }

private:
  static constexpr size_t kLarge = size_t{1} << 21; ///< a huge page of most processors

#ifdef __linux__
  /// From the beginning of a huge page on.
  static void* map(size_t bytes) {
    void* all = mmap(nullptr, bytes + kLarge, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (all == MAP_FAILED) throw std::bad_alloc();
    auto* first = static_cast<std::byte*>(all);
    const size_t before = (kLarge - reinterpret_cast<uintptr_t>(all) % kLarge) % kLarge;
    std::byte* at = first + before;
    // What is left over goes back, in whole pages.
    const auto page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
    std::byte *end = at + (bytes + page - 1) / page * page, *last = first + bytes + kLarge;
    if (before > 0) munmap(first, before);
    if (last > end) munmap(end, static_cast<size_t>(last - end));
    // Without huge pages all works the same, only slower.
    (void)madvise(at, bytes, MADV_HUGEPAGE);
#ifdef MADV_POPULATE_WRITE
    // The small pages behind the last huge one cost less when they come together.
    if (const size_t huge = bytes / kLarge * kLarge; huge < bytes)
      (void)madvise(at + huge, static_cast<size_t>(end - at) - huge, MADV_POPULATE_WRITE);
#endif
    return at;
  }
#endif
};

} // namespace render
