// A debrief that is steered from elsewhere (app/evaluation/debrief_guide): does what was asked for, and tells what is
// shown. Render thread; microseconds a frame, and what the guide takes.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

#include "app/debrief/debrief_player.h"
#include "app/evaluation/debrief_guide.h"

namespace app {

/// Errors and touches.
std::vector<DebriefGuide::Mark> incidentsOf(const DebriefRun& run);
/// What was asked for; true: a hand drags along the time line.
bool steer(Transport& transport, const DebriefGuide::Steered& wanted);

class DebriefSteering {
 public:
  /// Borrows both.
  DebriefSteering(DebriefGuide& guide, DebriefPlayer& player);

  void take();
  /// After drawing.
  void tell(bool is_new_picture);
  bool isOver() const { return guide_.isOver(); }

 private:
  DebriefGuide& guide_;
  DebriefPlayer& player_;
  std::vector<DebriefGuide::Mark> incidents_;
  bool knows_incidents_ = false;
  std::optional<std::chrono::steady_clock::time_point> dragged_at_;  ///< none: no hand drags
  std::function<render::Image()> picture_;
};

}  // namespace app
