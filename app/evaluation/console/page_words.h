// What the page's process and the rehearsal say to each other: JSON texts, each behind its length (4 bytes, little
// endian). The rehearsal trusts nothing in them: what is no such message is nonsense, and the process that says it is
// replaced. Plain values; any thread; microseconds a message.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "app/evaluation/debrief_guide.h"
#include "app/study/session_log.h"

namespace app {

inline constexpr std::size_t kMostUp = 64U << 10U, kMostDown = 4U << 20U;  ///< bytes of a text, to and from the session

std::string framed(std::string_view text);

/// Bytes as they arrive, cut into texts again.
class FrameReader {
 public:
  explicit FrameReader(std::size_t most) : most_(most) {}

  /// False: a text would be empty or longer than allowed; nothing more is read.
  bool add(std::span<const char> bytes);
  std::optional<std::string> next();

 private:
  std::size_t most_;
  std::string open_;
  std::deque<std::string> texts_;
  bool is_broken_ = false;
};

/// Something that a person said at a page: event.t_ns is the station's clock as the page knows it.
struct PageEvent {
  std::string page, session;   ///< random ids
  std::uint64_t number = 0;    ///< of that page, from 1
  double round_trip_ms = 0.0;  ///< of its clock
  LogEvent event;              ///< no more of data than its type has
};
struct PageServes {};
struct PageLives {
  int pages = 0;  ///< that look on
};
struct PagePairs {
  std::int64_t request = 0;
  std::string digits;
};
/// Of the debrief.
using PageSteers = DebriefGuide::Steered;
using PageWord = std::variant<PageEvent, PageServes, PageLives, PagePairs, PageSteers>;

/// None: nonsense.
std::optional<PageWord> pageWordFrom(std::string_view text);

std::string acknowledged(const std::string& page, std::uint64_t number);
std::string refusedWith(const std::string& page, std::uint64_t number, const std::string& why);

/// An id made by a page: 1 to 64 letters, digits and -.
bool isPageId(std::string_view id);

}  // namespace app
