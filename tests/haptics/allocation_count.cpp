#include "tests/haptics/allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> count{0};
thread_local std::size_t count_here = 0;
}  // namespace

namespace haptics::allocation_count {
std::size_t now() { return count.load(); }
std::size_t onThisThread() { return count_here; }
}  // namespace haptics::allocation_count

// Replaces the allocation functions of this executable; the array and nothrow forms end here too.
void* operator new(std::size_t size) {
  count.fetch_add(1);
  ++count_here;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
