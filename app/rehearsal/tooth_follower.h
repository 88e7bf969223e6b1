// What becomes of the tooth while it is sectioned, in words for the surgeon: how thick the bridge is that still holds
// it and what breaks it, and into which pieces it has come apart; and the orders to the servo: to make a piece that has
// fallen apart two, and to break a bridge when enough force comes.
// Looks on threads of its own, one a piece (procedure/teeth_watch); main thread.
// Without a tooth of its own (haptics/body/bodies) it says nothing.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "app/procedure/teeth_watch.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/tick.h"

namespace app {

/// "in 2 pieces, 412 and 324 mm³", "held by a bridge of 14.0 mm², 1.9 mm thick, which
/// breaks at about 0.51 N m"; empty: whole.
std::string toothText(const haptics::ToothFindings& findings);

class ToothFollower {
 public:
  /// Borrows the bodies. `whole`: the tooth before the first cut, in the order of its grid; empty: as it is.
  explicit ToothFollower(haptics::Bodies& bodies, std::span<const std::uint8_t> whole = {});

  /// Once a frame. `bricks`: of the jaw's grid, changed up to the newest tick or later. `waits`: for a servo that is
  /// stepped, and looks only when nothing has changed since the last call.
  void follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, bool waits);
  /// What the servo shall split, once nothing has changed between two calls of follow(): the serial is the caller's.
  std::optional<haptics::SplitOrder> order(const haptics::Tick& newest);
  /// The bridge to be armed while an instrument that can break it is `in_hand`, once nothing changes; alike. Call it
  /// after follow(), when the newest command was in force in `newest`.
  std::optional<haptics::BreakOrder> bridgeOrder(const haptics::Tick& newest, bool in_hand, bool waits);
  /// A line when the bridge is armed, when it has become thinner than 3, 2 or 1 mm, or a piece has come apart.
  std::optional<std::string> news();
  /// Of the thinnest bridge that holds the tooth, or a piece of it; none: none is cut to a bridge, or not looked yet.
  std::optional<double> bridge_mm();
  /// With the servo stopped: all of the tooth, looked at once more, as toothText().
  std::string ending();

 private:
  bool mayLook(const haptics::Tick& newest);
  void watchAnew(std::size_t pieces);
  void give(std::span<const glm::ivec3> bricks);
  void giveAll();
  void settle();
  haptics::ToothFindings found();

  haptics::Bodies& bodies_;
  std::vector<std::uint8_t> whole_;
  std::vector<std::unique_ptr<TeethWatch>> watches_;  ///< by piece; none: no tooth
  std::deque<haptics::SplitPlan> plans_;              ///< of all orders: the servo reads them
  std::deque<haptics::BreakPlan> breaks_;             ///< alike
  std::vector<const haptics::BreakPlan*> to_arm_;     ///< by piece; null: none
  /// The order without answer; null: none, or the piece has changed since.
  std::optional<std::pair<std::size_t, const haptics::BreakPlan*>> arming_;
  std::string armed_news_;
  std::array<bool, haptics::kMaxPieces> is_out_{};  ///< nobody breaks a bridge of those
  std::vector<glm::ivec3> unseen_;                  ///< of the tooth's grid, since the last look
  std::optional<std::uint64_t> quiet_at_;           ///< digest of the bodies at the last call
  bool is_quiet_ = false;                           ///< at the last call, bricks included
  bool is_partial_ = false;                         ///< bricks were left out while a piece moved block by block
  std::uint64_t looks_ = 0;
  std::size_t pieces_told_ = 1;
  int bridge_told_mm_ = 4;  ///< the limit told last
};

}  // namespace app
