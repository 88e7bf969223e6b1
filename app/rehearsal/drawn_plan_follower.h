// The surgeon draws where the trough and the section shall be, by touching bone and tooth with the tip of whatever is
// in the hand, before anything is cut: the lines are drawn in the picture and recorded, and at the end compared with
// what was removed since. Main thread, once a frame; the first point copies the bodies, some 30 ms.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/rehearsal/event_log.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/session/drawn_plan_event.h"
#include "haptics/body/bodies.h"
#include "render/frame.h"

namespace app {

class DrawnPlanFollower {
 public:
  /// Borrows all. A plan that was drawn before (RehearsalPlan::drawn) is there from the beginning.
  DrawnPlanFollower(const RehearsalPlan& plan, const haptics::Bodies& bodies, EventLog& event_log);

  /// The next point of the line in hand. Returns what to say.
  std::string mark(const glm::dvec3& p_P_mm);
  /// The trough's line is drawn; the section's; once more: all anew.
  std::string nextLine();
  std::vector<render::Bead> beads() const;
  /// Before the station stops, which takes the event: the cut against the lines; none: nothing was drawn.
  std::optional<DrawnComparison> finish();

 private:
  enum class Drawing : std::uint8_t { trough, section, done };
  void begin();
  void record();

  const RehearsalPlan& plan_;
  const haptics::Bodies& bodies_;
  EventLog& event_log_;
  DrawnPlan drawn_;
  Drawing drawing_ = Drawing::trough;
  std::vector<std::uint8_t> jaw_before_, tooth_before_;  ///< when the first point was drawn; empty: none is
};

}  // namespace app
