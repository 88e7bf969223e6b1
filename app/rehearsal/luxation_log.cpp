#include "app/rehearsal/luxation_log.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/text/clock_text.h"

namespace app {
namespace {

constexpr double kFulcrum_s = 0.05;  // it counts (reference/extraction 5.3)

}  // namespace

std::vector<LuxationLog::Told> LuxationLog::follow(std::span<const haptics::Tick> ticks, bool forceps_in_hand,
                                                   bool ready, const std::function<double(std::size_t)>& volume_mm3) {
  std::vector<Told> told;
  for (const haptics::Tick& tick : ticks) {
    const bool closes = tick.hand.drill_pedal && !was_closed_;
    was_closed_ = tick.hand.drill_pedal;
    if (closes && forceps_in_hand && tick.gripped == 0)
      told.push_back({ready ? "nothing between the beaks" : "the forceps are not ready yet, open them and wait"});
    for (std::size_t piece = 0; piece < haptics::kMaxPieces; ++piece)
      if (auto line = follow(tick, piece, volume_mm3)) told.push_back(std::move(*line));
    torn_share_ = tick.torn_share;
    followBridge(tick.broken, tick.gripped == 0, told);
    followFulcrum(tick, told);
    if (tick.gripped != 0) {
      held_s_ += tick.dt_s;
      most_N_ = std::max(most_N_, glm::length(tick.grip_force_P_N.xyz));
      followLigament(tick, tick.gripped - 1u, false, told);
    } else if (tick.lever.piece != 0) {
      levered_s_ += tick.dt_s;
      most_Nmm_ = std::max(most_Nmm_, std::abs(tick.lever.twist_Nmm));
      followLigament(tick, tick.lever.piece - 1u, true, told);
    }
  }
  return told;
}

void LuxationLog::followLigament(const haptics::Tick& tick, std::size_t piece, bool by_elevator,
                                 std::vector<Told>& told) {
  const int quarters = tick.torn_share >= haptics::kLooseShare ? 4 : static_cast<int>(4.0 * tick.torn_share);
  int& before = torn_told_[piece];
  if (quarters > before)
    told.push_back({quarters == 4 ? "the piece is loose" : fmt::format("{} % of the ligament is torn", 25 * quarters),
                    quarters == 4, by_elevator});
  // Fewer than before after an undo.
  before = quarters;
}

void LuxationLog::followBridge(const haptics::BrokenBridge& broken, bool by_elevator, std::vector<Told>& told) {
  if (broken.piece == 0) return;
  ++bridges_broken_;
  told.push_back(
      {fmt::format("the bridge of {:.0f} mm² broke at {:.0f} N, {:.2f} N m{}", broken.area_mm2, broken.force_N,
                   1e-3 * broken.bending_Nmm, broken.is_complete ? "" : ", not clean: a spur stays on the root"),
       true, by_elevator});
}

/// Said when it has lasted, recorded with its largest force when it is over.
void LuxationLog::followFulcrum(const haptics::Tick& tick, std::vector<Told>& told) {
  if (!tick.lever.restsOnTeeth()) {
    if (fulcrum_s_ >= kFulcrum_s)
      told.push_back(
          {fmt::format("a neighbouring tooth bore {:.0f} N of the elevator (model)", fulcrum_N_), true, true});
    fulcrum_s_ = fulcrum_N_ = 0.0;
    return;
  }
  const double before_s = fulcrum_s_;
  fulcrum_s_ += tick.dt_s;
  fulcrum_N_ = std::max(fulcrum_N_, tick.lever.on_teeth_N);
  if (fulcrum_s_ < kFulcrum_s) return;
  most_fulcrum_N_ = std::max(most_fulcrum_N_, fulcrum_N_);
  if (before_s < kFulcrum_s) told.push_back({"the elevator rests on a neighbouring tooth", false, true});
}

/// By where the piece is: undo brings one back, redo takes it out again.
std::optional<LuxationLog::Told> LuxationLog::follow(const haptics::Tick& tick, std::size_t piece,
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

std::string LuxationLog::summary() const {
  if (held_s_ <= 0.0 && levered_s_ <= 0.0) return "";
  std::string words;
  for (std::size_t n = 0; n < out_.size(); ++n)
    words += fmt::format("{}{:.0f}", n == 0 ? "" : n + 1 == out_.size() ? " and " : ", ", out_[n].mm3);
  words = out_.empty() ? "nothing taken out" : words + " mm³ taken out";
  if (bridges_broken_ > 0)
    words += fmt::format(", {} bridge{} broken", bridges_broken_, bridges_broken_ == 1 ? "" : "s");
  if (held_s_ > 0.0)
    words += fmt::format(", held for {}, pulled with {:.0f} N at most (model)", clockText(held_s_), most_N_);
  if (levered_s_ > 0.0)
    words += fmt::format(", levered for {} with {:.2f} N m at most (model)", clockText(levered_s_), most_Nmm_ / 1000.0);
  if (most_fulcrum_N_ > 0.0) words += fmt::format(", a neighbouring tooth bore {:.0f} N (model)", most_fulcrum_N_);
  return words + fmt::format(", {:.0f} % of the ligament torn", 100.0 * torn_share_);
}

std::string luxationText(const haptics::Tick& tick, const haptics::Tool& tool, bool ready) {
  const bool works = tool.grips ? tick.gripped != 0 : tick.lever.piece != 0;
  if (!works) return !ready ? "not ready" : tool.grips ? "open" : "free";
  if (tick.bridge_share > 0.05) return fmt::format("bridge {:.0f} %", 100.0 * tick.bridge_share);
  return tick.torn_share >= haptics::kLooseShare ? "loose" : fmt::format("torn {:.0f} %", 100.0 * tick.torn_share);
}

}  // namespace app
