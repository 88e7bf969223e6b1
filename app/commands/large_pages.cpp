// The program's large blocks of memory on huge pages. A rehearsal fills 1.3 GB of volumes, surfaces and pictures as it
// starts; a page fault for each 4 KiB of it took a sixth of the processor time to the first picture (189,000 faults
// before, 75,000 with huge pages). Linux gives them only to whom asks (madvise), glibc asks only by an environment
// variable. Any thread; a system call for each block of 4 MiB and more.

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

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

void* operator new(std::size_t bytes) {
  void* const block = bytes >= kLarge_bytes ? largeBlock(bytes) : std::malloc(bytes == 0 ? 1 : bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
