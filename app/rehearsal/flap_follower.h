// Incision and flap during a rehearsal that began with the gum closed: every tick with the command that was in force,
// what the servo shall let give way, what is drawn, lines for the surgeon, events of the recording. Main thread, once a
// frame.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "app/procedure/flap/flap.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "render/frame.h"

namespace app {

class FlapFollower {
 public:
  /// Borrows both; `plan` has a cut and its gum closed.
  FlapFollower(const RehearsalPlan& plan, EventLog& event_log);

  /// Every tick in order. `command`: the newest, with the serial it has been given.
  void follow(std::span<const haptics::Tick> ticks, const haptics::Command& command, std::uint64_t serial);
  /// Once a frame.
  void show(render::Frame& frame);
  void finish() { tell(true); }

  const Flap& flap() const { return flap_; }
  std::optional<std::string> news();
  const FlapRecord& newest() const { return told_; }

 private:
  void tell(bool is_last);

  const RehearsalPlan& plan_;
  EventLog& event_log_;
  Flap flap_;
  std::deque<std::pair<std::uint64_t, haptics::Command>> commands_;  ///< by serial, the oldest still in ticks first
  FlapRecord told_;
  double now_s_ = 0.0, told_s_ = 0.0;
  std::deque<std::string> news_;
  assets::MeshModel gum_, sheet_;  ///< as drawn
  std::uint64_t drawn_sheet_ = 0, drawn_incision_ = 0, drawn_number_ = 0, flap_serial_ = 0;
};

}  // namespace app
