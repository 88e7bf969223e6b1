#include "app/rehearsal/grip_log.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/text/clock_text.h"

namespace app {

std::vector<GripLog::Told> GripLog::follow(std::span<const haptics::Tick> ticks, bool forceps_in_hand, bool ready,
                                           const std::function<double(std::size_t)>& volume_mm3) {
  std::vector<Told> told;
  for (const haptics::Tick& tick : ticks) {
    const bool closes = tick.hand.drill_pedal && !was_closed_;
    was_closed_ = tick.hand.drill_pedal;
    if (closes && forceps_in_hand && tick.gripped == 0)
      told.push_back({ready ? "nothing between the beaks" : "the forceps are not ready yet, open them and wait"});
    for (std::size_t piece = 0; piece < haptics::kMaxPieces; ++piece)
      if (auto line = follow(tick, piece, volume_mm3)) told.push_back(std::move(*line));
    torn_share_ = tick.torn_share;
    if (tick.gripped == 0) continue;
    held_s_ += tick.dt_s;
    most_N_ = std::max(most_N_, glm::length(tick.grip_force_P_N.xyz));
    const int quarters = tick.torn_share >= 0.999 ? 4 : static_cast<int>(4.0 * tick.torn_share);
    int& before = torn_told_[tick.gripped - 1u];
    if (quarters > before)
      told.push_back({quarters == 4 ? "the piece is loose" : fmt::format("{} % of the ligament is torn", 25 * quarters),
                      quarters == 4});
    // Fewer than before after an undo.
    before = quarters;
  }
  return told;
}

/// By where the piece is: undo brings one back, redo takes it out again.
std::optional<GripLog::Told> GripLog::follow(const haptics::Tick& tick, std::size_t piece,
                                             const std::function<double(std::size_t)>& volume_mm3) {
  const bool is_out = piece < tick.pieces && haptics::Bodies::isAside(tick.X_PQ[piece]);
  const auto known = std::ranges::find(out_, piece, &Out::piece);
  if (is_out == (known != out_.end())) return {};
  if (is_out) {
    out_.push_back({piece, volume_mm3(piece)});
    return Told{fmt::format("out: a piece of {:.0f} mm³", out_.back().mm3), true};
  }
  const Told back{fmt::format("back in the mouth: a piece of {:.0f} mm³", known->mm3), true};
  out_.erase(known);
  return back;
}

std::string GripLog::summary() const {
  if (held_s_ <= 0.0) return "";
  std::string words;
  for (std::size_t n = 0; n < out_.size(); ++n)
    words += fmt::format("{}{:.0f}", n == 0 ? "" : n + 1 == out_.size() ? " and " : ", ", out_[n].mm3);
  words = out_.empty() ? "nothing taken out" : words + " mm³ taken out";
  return words + fmt::format(", held for {}, pulled with {:.0f} N at most (model), {:.0f} % of the ligament torn",
                             clockText(held_s_), most_N_, 100.0 * torn_share_);
}

std::string forcepsText(const haptics::Tick& tick, bool ready) {
  if (tick.gripped == 0) return ready ? "open" : "not ready";
  return tick.torn_share >= 0.999 ? "loose" : fmt::format("torn {:.0f} %", 100.0 * tick.torn_share);
}

}  // namespace app
