// Large arrays of zeros: pages come from the system as they are, in huge pages where it has them, and are not
// touched before somebody writes there.
#pragma once

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
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
    if (bytes >= kLarge) {
      void* at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
      if (at == MAP_FAILED) throw std::bad_alloc();
      // Without huge pages all works the same, only slower.
      (void)madvise(at, bytes, MADV_HUGEPAGE);
      return static_cast<T*>(at);
    }
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
};

} // namespace render
