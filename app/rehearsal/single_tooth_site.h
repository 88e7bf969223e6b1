// The one tooth of a root-canal treatment or a preparation during a rehearsal, followed once a frame: files in its
// canals, the way through its roof, the apex locator, and what the work has come to after each stroke. Gives the
// surgeon lines, the recording events, the picture the inset at a file's tip. A rehearsal without such a tooth has one
// too: it does nothing. Main thread; some µs a tick and a frame; measuring is done on threads of the watches.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "app/procedure/preparation/bite_watch.h"
#include "app/procedure/preparation/preparation_watch.h"
#include "app/procedure/root_canal/access_watch.h"
#include "app/procedure/root_canal/treatment_watch.h"
#include "app/rehearsal/canal_log.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/head_up.h"
#include "app/rehearsal/locator_watch.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/tooth_painting.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"

namespace app {

class SingleToothSite {
 public:
  struct Links {
    const RehearsalPlan& plan;
    const haptics::Bodies& bodies;
    HeadUp& head_up;
    EventLog& event_log;
    bool is_real_time = true;  ///< else nothing is measured on the way: a stepped rehearsal repeats itself
  };
  /// Before the first tick. Borrows all. Throws UsageError: the ideal does not fit the tooth.
  explicit SingleToothSite(const Links& links);

  /// The recording has begun.
  void start();
  /// All ticks, in order, made with the command in force.
  void follow(std::span<const haptics::Tick> ticks, const haptics::Tool& tool);
  /// Once a frame: what the newest tick is seen and heard by.
  void followHand(const haptics::Tick& newest, const haptics::Command& command, render::Frame& picture);
  /// What broken files have left in the tooth, if that has changed since the last call.
  std::optional<std::span<const assets::MetalFragment>> takeFragments();
  /// Once a frame. `bricks`: of the jaw's grid, changed since the last call. The picture is lent what is painted on the
  /// tooth.
  void followBone(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, render::Frame& picture);
  /// The jaws close on articulating paper.
  void bite(const haptics::Tick& newest);
  /// With the servo stopped, for a last picture: paints the tooth as it is left, where its layers ask for it. Waits.
  void paintNow(render::Frame& picture);
  /// Before the recording is closed.
  void finish();

  /// What the work has come to so far; empty: nothing was measured.
  std::string outcomeLine() const;
  /// Of the file in a canal; empty: none is.
  std::string fileLine(const haptics::Tick& newest) const;
  /// Of a bur's end while it turns within a crown that has such bands.
  std::optional<double> belowCusp_mm() const;
  /// What the apex locator shows; none: it has none, or no file is in a canal.
  const std::optional<LocatorTold>& located() const;
  /// CanalLog::summary().
  std::string canals() const { return canal_log_ ? canal_log_->summary() : std::string(); }

 private:
  void tellIncrements(double t_s);
  void tell(const std::string& line, double t_s, const char* kind);
  void tellBite();

  Links links_;
  std::optional<CanalLog> canal_log_;
  std::optional<AccessWatch> access_;
  std::optional<LocatorWatch> locator_;
  std::optional<TreatmentWatch> treatment_;
  std::optional<PreparationWatch> preparation_;
  std::set<int> deep_increments_;  ///< told
  bool tells_full_ = false;
  std::optional<BiteWatch> bite_;
  std::optional<ToothPainting> painting_;
  bool tells_blocks_ = false;  ///< that the live tooth is cut by whole blocks
};

}  // namespace app
