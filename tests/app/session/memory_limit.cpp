#include "tests/app/session/memory_limit.h"

#include <cstdlib>
#include <new>

std::atomic<bool> app::test::memory_is_out{false};

void* operator new(std::size_t bytes) {
  if (!app::test::memory_is_out)
    if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
