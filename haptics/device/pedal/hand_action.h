// The actions of pedals and buttons, and how switches become them: held actions as a set of bits, presses as counts, so
// that a late reader misses none. Pure values; any thread, no allocation. The application executes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace haptics {

enum class HandAction : std::uint8_t { drill, irrigation, undo, tool_change };

inline constexpr std::size_t kHandActions = 4;
inline constexpr std::array<std::string_view, kHandActions> kHandActionNames = {"drill", "irrigation", "undo", "tool"};

constexpr std::string_view nameOf(HandAction action) { return kHandActionNames[static_cast<std::size_t>(action)]; }

/// "tool-change" is an older name of tool.
constexpr std::optional<HandAction> handActionNamed(std::string_view name) {
  if (name == "tool-change") return HandAction::tool_change;
  for (std::size_t i = 0; i < kHandActions; ++i)
    if (kHandActionNames[i] == name) return static_cast<HandAction>(i);
  return {};
}

/// The actions that are held down now.
struct HandActions {
  std::uint8_t bits = 0;

  constexpr bool has(HandAction action) const { return (bits >> static_cast<unsigned>(action) & 1u) != 0; }
  constexpr HandActions with(HandAction action) const {
    return {static_cast<std::uint8_t>(bits | 1u << static_cast<unsigned>(action))};
  }
  constexpr HandActions operator|(HandActions other) const { return {static_cast<std::uint8_t>(bits | other.bits)}; }
  bool operator==(const HandActions&) const = default;
};

/// The action of each button on the handle, bit 0 first: the first drills, the second changes the tool.
struct ButtonMeanings {
  std::array<std::optional<HandAction>, 32> of_bit = {HandAction::drill, HandAction::tool_change};

  constexpr HandActions actionsOf(std::uint32_t buttons) const {
    HandActions held;
    for (std::size_t bit = 0; bit < of_bit.size(); ++bit)
      if ((buttons >> bit & 1u) != 0 && of_bit[bit]) held = held.with(*of_bit[bit]);
    return held;
  }
};

/// Counts how often each action began.
class PressCount {
 public:
  /// The actions that began since the last call.
  constexpr HandActions look(HandActions held) {
    const HandActions begun{static_cast<std::uint8_t>(held.bits & ~held_.bits)};
    held_ = held;
    for (std::size_t i = 0; i < kHandActions; ++i) presses_[i] += begun.bits >> i & 1u;
    return begun;
  }
  constexpr std::uint32_t of(HandAction action) const { return presses_[static_cast<std::size_t>(action)]; }

 private:
  HandActions held_;
  std::array<std::uint32_t, kHandActions> presses_{};
};

}  // namespace haptics
