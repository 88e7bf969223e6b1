// From where the work is seen: the eyes and the instrument in the other hand, recorded whenever they have moved, and
// whether what the bur takes away is hidden from both eyes. Frame P, mm. Main thread, once a frame; 0.1 ms.
#pragma once

#include <optional>
#include <span>

#include "app/device/second_hand.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/session/eyes_event.h"
#include "app/session/glass_fog.h"
#include "app/session/second_hand_event.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"

namespace app {

class SightWatch {
 public:
  /// Borrows all.
  SightWatch(const RehearsalPlan& plan, EventLog& event_log) : plan_(plan), event_log_(event_log) {}

  /// Of the frame to be drawn: of one picture for both eyes, they are between them.
  void noteEyes(const calibration::Rig& rig);
  /// Places the other hand's instrument in the picture, its glass as breath and spray leave it; null: there is none.
  void followHand(SecondHand* hand, const haptics::Tick& newest, bool irrigating, render::Frame& picture);
  /// By the newest tick that removes something: not every tick of a cut does. `solid`: jaw and pieces, in the order of
  /// `grid`.
  bool worksOutOfSight(std::span<const haptics::Tick> ticks, const haptics::Command& command,
                       const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid) const;

 private:
  const RehearsalPlan& plan_;
  EventLog& event_log_;
  std::optional<EyesPlace> eyes_;               ///< as noted last
  std::optional<SecondHandPlace> second_hand_;  ///< alike
  GlassFog fog_;
};

}  // namespace app
