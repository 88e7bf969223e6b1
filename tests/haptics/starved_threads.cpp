#include "tests/haptics/starved_threads.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<bool> others_starve{false};
bool isFirstThread() { return syscall(SYS_gettid) == getpid(); }
}  // namespace

namespace haptics {
void starve(bool others) noexcept { others_starve.store(others); }
}  // namespace haptics

// Replaces the allocation functions of this executable; the array and nothrow forms end here too.
void* operator new(std::size_t size) {
  if (others_starve.load() && !isFirstThread()) throw std::bad_alloc();
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
