#include "app/evaluation/seat/seat_arena.h"

#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <fstream>
#include <new>
#include <string>
#include <vector>

#include <boost/interprocess/mem_algo/rbtree_best_fit.hpp>
#include <boost/interprocess/sync/mutex_family.hpp>

namespace {

// Without a lock: one thread. Its own book lies at the beginning of the range, and goes with a state.
using ArenaHeap = boost::interprocess::rbtree_best_fit<boost::interprocess::null_mutex_family>;

constexpr std::uintptr_t kArenaAt = 0x2000'0000'0000;
constexpr std::size_t kArenaPage = 4096;

thread_local bool is_arena_on = false;
bool has_hooks = false;
ArenaHeap* arena_heap = nullptr;
std::size_t arena_used = 0;  ///< from kArenaAt on

bool isInArena(const void* at) {
  const auto address = reinterpret_cast<std::uintptr_t>(at);
  return address >= kArenaAt && address < kArenaAt + app::SeatArena::kMost_bytes;
}

void* arenaMemory(std::size_t bytes, std::size_t alignment) {
  void* const at = arena_heap->allocate_aligned(bytes, std::max<std::size_t>(alignment, 16));
  if (at == nullptr) throw std::bad_alloc();
  arena_used = std::max(arena_used, reinterpret_cast<std::uintptr_t>(at) + bytes - kArenaAt);
  return at;
}

}  // namespace

namespace app {
namespace {

/// Two places behind it.
struct StatesHead {
  struct Place {
    std::uint64_t serial = 0, used = 0, root = 0;
    std::uint64_t code = 0, constants = 0, program = 0;  ///< of the program that kept it
  };
  std::array<Place, 2> places;
};
static_assert(sizeof(StatesHead) <= kArenaPage);

constexpr std::size_t placeAt(std::size_t number) { return kArenaPage + number * SeatArena::kMost_bytes; }

/// Where this program's code and constants lie, and which it is.
StatesHead::Place ownPlace() {
  StatesHead::Place own;
  own.code = reinterpret_cast<std::uint64_t>(&SeatArena::keep);
  own.constants = reinterpret_cast<std::uint64_t>(&std::nothrow);
  struct stat about {};
  if (::stat("/proc/self/exe", &about) == 0)
    own.program = static_cast<std::uint64_t>(about.st_ino) * 31 + static_cast<std::uint64_t>(about.st_mtim.tv_nsec) +
                  static_cast<std::uint64_t>(about.st_size);
  return own;
}

bool isOfThisProgram(const StatesHead::Place& place) {
  const StatesHead::Place own = ownPlace();
  return place.serial > 0 && place.code == own.code && place.constants == own.constants &&
         place.program == own.program && place.used <= SeatArena::kMost_bytes && place.root >= kArenaAt &&
         place.root < kArenaAt + place.used;
}

bool isSamePage(const std::byte* one, const std::byte* other) { return std::memcmp(one, other, kArenaPage) == 0; }

/// Pages that stand there already are not written again.
void keepPages(std::byte* to, std::size_t bytes) {
  const auto* const from = reinterpret_cast<const std::byte*>(arena_heap);
  for (std::size_t at = 0; at < bytes; at += kArenaPage)
    if (!isSamePage(to + at, from + at)) std::memcpy(to + at, from + at, kArenaPage);
}

/// Mapped while it is looked at.
class States {
 public:
  explicit States(int memory) {
    struct stat about {};
    if (::fstat(memory, &about) != 0 || about.st_size != static_cast<off_t>(SeatArena::kStates_bytes)) return;
    void* const at = ::mmap(nullptr, SeatArena::kStates_bytes, PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
    if (at != MAP_FAILED) at_ = static_cast<std::byte*>(at);
  }
  ~States() {
    if (at_ != nullptr) ::munmap(at_, SeatArena::kStates_bytes);
  }
  States(const States&) = delete;
  States& operator=(const States&) = delete;

  bool isThere() const { return at_ != nullptr; }
  StatesHead& head() { return *static_cast<StatesHead*>(static_cast<void*>(at_)); }
  std::byte* place(std::size_t number) { return at_ + placeAt(number); }

 private:
  std::byte* at_ = nullptr;
};

}  // namespace

bool SeatArena::hook() { return has_hooks = true; }

void* SeatArena::memoryInside(std::size_t bytes, std::size_t alignment) {
  return is_arena_on ? arenaMemory(bytes, alignment) : nullptr;
}

bool SeatArena::freedInside(void* at) noexcept {
  if (!isInArena(at)) return false;
  arena_heap->deallocate(at);
  return true;
}

bool SeatArena::startAtFixedAddresses() {
  constexpr unsigned long kAsk = 0xffffffff;
  const int now = ::personality(kAsk);
  if (now < 0 || !has_hooks) return false;
  if ((static_cast<unsigned>(now) & ADDR_NO_RANDOMIZE) != 0) return true;
  if (::personality(static_cast<unsigned>(now) | ADDR_NO_RANDOMIZE) < 0) return false;
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv("/proc/self/exe", arguments.data());
  return false;
}

bool SeatArena::open() {
  if (!has_hooks) return false;
  void* const at = ::mmap(reinterpret_cast<void*>(kArenaAt), kMost_bytes, PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED_NOREPLACE, -1, 0);
  if (at != reinterpret_cast<void*>(kArenaAt)) return false;
  arena_heap = new (at) ArenaHeap(kMost_bytes, 0);
  arena_used = kArenaPage;
  return true;
}

void* SeatArena::bringBack(int states) {
  States kept(states);
  if (!kept.isThere() || arena_heap == nullptr) return nullptr;
  const std::array<StatesHead::Place, 2> places = kept.head().places;
  const std::size_t newest = places[1].serial > places[0].serial ? 1 : 0;
  const StatesHead::Place& place = places[newest];
  if (!isOfThisProgram(place)) return nullptr;
  // Pages of zeros are zeros already.
  static constexpr std::array<std::byte, kArenaPage> kZeros{};
  auto* const to = reinterpret_cast<std::byte*>(kArenaAt);
  for (std::size_t at = 0; at < place.used; at += kArenaPage)
    if (!isSamePage(kept.place(newest) + at, kZeros.data())) std::memcpy(to + at, kept.place(newest) + at, kArenaPage);
  arena_used = place.used;
  return reinterpret_cast<void*>(place.root);
}

bool SeatArena::keep(int states, void* root) {
  States kept(states);
  if (!kept.isThere() || arena_heap == nullptr) return false;
  std::array<StatesHead::Place, 2>& places = kept.head().places;
  const bool is_second_newer = places[1].serial > places[0].serial;
  const std::uint64_t serial = (is_second_newer ? places[1] : places[0]).serial + 1;
  StatesHead::Place& older = is_second_newer ? places[0] : places[1];
  // A kill between any two of these writes leaves the newer place whole, and the older one without a number.
  older.serial = 0;
  std::atomic_signal_fence(std::memory_order_seq_cst);
  const std::size_t used = (arena_used + kArenaPage - 1) / kArenaPage * kArenaPage;
  keepPages(kept.place(is_second_newer ? 0 : 1), used);
  older = ownPlace();
  older.used = used, older.root = reinterpret_cast<std::uint64_t>(root);
  std::atomic_signal_fence(std::memory_order_seq_cst);
  older.serial = serial;
  return true;
}

SeatArena::Inside::Inside() : before_(is_arena_on) { is_arena_on = arena_heap != nullptr; }
SeatArena::Inside::~Inside() { is_arena_on = before_; }

std::size_t SeatArena::used_bytes() { return arena_used; }

}  // namespace app
