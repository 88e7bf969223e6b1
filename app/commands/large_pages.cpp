// The program's large blocks of memory on huge pages. A rehearsal fills 1.3 GB of volumes, surfaces and pictures as it
// starts; a page fault for each 4 KiB of it took a sixth of the processor time to the first picture (189,000 faults
// before, 75,000 with huge pages). Linux gives them only to whom asks (madvise), glibc asks only by an environment
// variable. Any thread; a system call for each block of 4 MiB and more. What a seat allocates within its arena
// (evaluation/seat/seat_arena) lies there.

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

#include "app/evaluation/seat/seat_arena.h"

namespace {

constexpr std::size_t kHugePage_bytes = std::size_t{2} << 20, kLarge_bytes = 2 * kHugePage_bytes;

void* largeBlock(std::size_t bytes) {
  if (bytes > SIZE_MAX - kHugePage_bytes) return nullptr;
  const std::size_t whole_pages = (bytes + kHugePage_bytes - 1) / kHugePage_bytes * kHugePage_bytes;
  void* const block = std::aligned_alloc(kHugePage_bytes, whole_pages);
  // Without huge pages in this kernel it stays an ordinary block.
  if (block != nullptr) madvise(block, whole_pages, MADV_HUGEPAGE);
  return block;
}

}  // namespace

namespace {

[[maybe_unused]] const bool kIsHooked = app::SeatArena::hook();

}  // namespace

void* operator new(std::size_t bytes) {
  if (void* const inside = app::SeatArena::memoryInside(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__)) return inside;
  void* const block = bytes >= kLarge_bytes ? largeBlock(bytes) : std::malloc(bytes == 0 ? 1 : bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto edge = static_cast<std::size_t>(alignment);
  if (void* const inside = app::SeatArena::memoryInside(bytes, edge)) return inside;
  const std::size_t least = bytes == 0 ? 1 : bytes;
  void* const block = least > SIZE_MAX - edge ? nullptr : std::aligned_alloc(edge, (least + edge - 1) / edge * edge);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void operator delete(void* block) noexcept {
  if (!app::SeatArena::freedInside(block)) std::free(block);
}
void operator delete(void* block, std::size_t) noexcept { operator delete(block); }
void operator delete(void* block, std::align_val_t) noexcept { operator delete(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { operator delete(block); }
