// What a seat says to its rehearsal: words of one size, in datagrams, and the book that the rehearsal keeps of them. A
// word may come twice, after another process has taken the work over: what is known already is passed over. Nothing in
// a datagram is trusted. Plain values; one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace app {

struct SeatWord {
  enum class Kind : std::uint32_t {
    value = 1,     ///< of id `number`, from this tick on
    no_value = 2,  ///< of id `number`, from this tick on
    through = 3,   ///< all ticks until this one are followed; `number`: ns of processor time so far
    deviates = 4,  ///< this tick came out otherwise than the servo's
    began = 5,     ///< a process goes on after this many ticks; `number` 1: another one died, 2: from a stored state
  };
  static constexpr std::uint32_t kMark = 0x7461'6573;

  std::uint32_t mark = kMark;
  Kind kind = Kind::through;
  std::uint64_t tick = 0, number = 0;
  double value = 0.0;
};
static_assert(sizeof(SeatWord) == 32);

inline constexpr std::size_t kMostSeatWords = 64;  ///< in a datagram

/// None: it is no datagram of a seat.
std::optional<std::vector<SeatWord>> seatWordsFrom(std::span<const std::byte> datagram);

class SeatBook {
 public:
  explicit SeatBook(std::vector<std::string> ids) : ids_(std::move(ids)), values_(ids_.size()) {}

  const std::vector<std::string>& ids() const { return ids_; }
  /// `made`: ticks that the servo has made so far. False: it cannot be so, nothing is taken.
  bool take(std::span<const SeatWord> words, std::uint64_t made);

  std::uint64_t followed() const { return followed_; }
  /// In a tick that is followed; those before it may not be asked for any more.
  std::optional<double> value(std::string_view id, std::uint64_t tick);
  /// From this tick on the bone is not the servo's; none: it is.
  std::optional<std::uint64_t> deviates() const { return deviates_; }
  std::uint64_t processor_ns() const { return processor_ns_; }
  /// Processes that were started, and those that took the work over from one that died.
  std::uint64_t begun() const { return begun_; }
  /// The one that was started last knew a stored state.
  bool isBroughtBack() const { return is_brought_back_; }
  std::uint64_t takenOver() const { return taken_over_; }

 private:
  struct Since {
    std::uint64_t tick = 0;
    std::optional<double> value;
  };
  bool fits(const SeatWord& word, std::uint64_t made) const;

  std::vector<std::string> ids_;
  std::vector<std::deque<Since>> values_;  ///< by id, in order of ticks
  std::uint64_t followed_ = 0, processor_ns_ = 0, begun_ = 0, taken_over_ = 0;
  std::optional<std::uint64_t> deviates_;
  bool is_brought_back_ = false;
};

}  // namespace app
