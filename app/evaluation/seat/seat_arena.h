// Memory whose content is a state that another process can go on from: all that is allocated while SeatArena::Inside
// lives lies in one range of addresses, the same in every process of this program (which is started without randomised
// addresses, so that its code, tables and constants lie where they lay too). A state is a copy of that range in shared
// memory that the rehearsal holds: two places, the older one is written over and counts once it is whole. So what a
// servo remembers (bone, undo, ligaments, sites, plans) need not be known here. What a process made from such a copy
// finds is checked tick by tick by the digests. Linux; one thread. 60 ms for 200 MB to keep or bring back, by what has
// changed.
#pragma once

#include <cstddef>
#include <cstdint>

namespace app {

class SeatArena {
 public:
  static constexpr std::size_t kMost_bytes = std::size_t{1} << 30U;
  /// Of the shared memory that states are kept in.
  static constexpr std::size_t kStates_bytes = 2 * kMost_bytes + 4096;

  /// Where addresses are randomised the program is started again without, with the same words; returns where they are
  /// not, or cannot be. False: then nothing can be kept.
  static bool startAtFixedAddresses();

  /// Once in a process. False: the range is taken.
  static bool open();
  /// The newest whole state of this program there: `root` as it was kept. Null: there is none; nothing was brought
  /// back.
  static void* bringBack(int states);
  /// What lies in the range now. False: it has no room there.
  static bool keep(int states, void* root);

  /// What is allocated meanwhile lies in the range; what is freed goes where it came from at any time.
  class Inside {
   public:
    Inside();
    ~Inside();
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;

   private:
    bool before_;
  };

  static std::size_t used_bytes();

  /// For the program's operator new and delete (app/commands/large_pages), which tell that they ask here first: null,
  /// false: not inside. Without them nothing can be kept.
  static bool hook();
  static void* memoryInside(std::size_t bytes, std::size_t alignment);
  static bool freedInside(void* at) noexcept;
};

}  // namespace app
