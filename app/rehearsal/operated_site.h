// The operated site during a rehearsal, followed once a frame: the tooth and its bridge, its pieces and what forceps
// and elevators do with them, the socket, ways out, lines drawn beforehand, the flap, stress in jaw, root and crown.
// Gives the servo its orders, the surgeon lines, the recording events, the picture what is drawn of it. Main thread;
// the cost of the followers that it has.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "app/controls/active_command.h"
#include "app/procedure/jaw_stress.h"
#include "app/procedure/root_stress.h"
#include "app/procedure/site_desk.h"
#include "app/procedure/steps/step_tracker.h"
#include "app/rehearsal/drawn_plan_follower.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/flap_follower.h"
#include "app/rehearsal/head_up.h"
#include "app/rehearsal/luxation_log.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/rehearsal_summary.h"
#include "app/rehearsal/socket_follower.h"
#include "app/rehearsal/tooth_follower.h"
#include "app/rehearsal/way_follower.h"
#include "render/frame.h"

namespace app {

class OperatedSite {
 public:
  struct Links {
    const RehearsalPlan& plan;
    Workstation& station;
    ActiveCommand& command;
    HeadUp& head_up;
    EventLog& event_log;
    bool waits = false;  ///< for a servo that is stepped
  };
  /// Before the first tick. Borrows all.
  explicit OperatedSite(const Links& links);

  /// All ticks, in order, made with the command in force.
  void follow(std::span<const haptics::Tick> ticks);

  struct Frame {
    std::span<const glm::ivec3> bricks;  ///< of the jaw's grid, changed since the last call
    const haptics::Tick& newest;
    std::span<const std::optional<glm::dvec3>> drawn;  ///< points of lines, or: the next line
    bool asks_way = false;
    bool is_shown = false;    ///< by a scripted hand, which looks for its own ways
    bool may_loosen = false;  ///< chips may leave the bone
  };
  /// Once a frame, after its ticks.
  void follow(const Frame& frame, render::Frame& picture);
  /// Before the recording is closed.
  void finish(std::span<const glm::ivec3> bricks, const haptics::Tick& newest);

  std::optional<double> bridge_mm() { return tooth_.bridge_mm(); }
  const std::optional<SocketRecord>& socket() const { return socket_.newest(); }
  std::optional<FlapFacts> flapFacts() const;
  /// Null: it was raised from the beginning.
  const Flap* flap() const { return flap_ ? &flap_->flap() : nullptr; }
  /// Every piece is ready for forceps and elevator.
  bool isReady() const { return sites_.isReady(); }
  SiteLeft left() const { return socket_.left(); }
  std::span<const std::uint8_t> solidInMouth() const { return socket_.solidInMouth(); }
  const JawStress& jawStress() const { return jaw_stress_; }
  const RootStress& rootStress() const { return root_stress_; }
  std::string socketLine() const { return socket_.line(); }
  std::string wayLine() const { return ways_.line(); }
  /// With the servo stopped.
  void describe(RehearsalFigures& figures);

 private:
  void followLuxation(std::span<const haptics::Tick> ticks);
  void followDrawn(const Frame& frame, render::Frame& picture);
  void followFlap(render::Frame& picture);
  void followWays(const Frame& frame, render::Frame& picture);
  void followStress(const haptics::Tick& newest);
  void makePiecesReady(const haptics::Tick& newest);

  Links links_;
  haptics::Bodies& bodies_;
  ToothFollower tooth_;
  SiteDesk sites_;
  SocketFollower socket_;
  WayFollower ways_;
  DrawnPlanFollower drawn_;
  std::optional<FlapFollower> flap_;
  JawStress jaw_stress_;
  RootStress root_stress_;
  LuxationLog luxation_;
  std::optional<DrawnComparison> compared_;
};

}  // namespace app
