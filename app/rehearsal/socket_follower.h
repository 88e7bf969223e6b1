// The socket during a rehearsal: chips and follicle that come loose and are taken (procedure/debris), and once a piece
// of the tooth is out what is left to do (procedure/socket): a line for the surgeon, what is drawn of it, events of the
// recording. Main thread, once a frame. Without a labelled tooth of its own it looks for chips alone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/procedure/debris/chip_desk.h"
#include "app/procedure/socket/socket_watch.h"
#include "app/procedure/third_molar/cleaning_plan.h"
#include "app/rehearsal/event_log.h"
#include "app/rehearsal/loose_site.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "haptics/servo/command.h"
#include "render/frame.h"

namespace app {

class SocketFollower {
 public:
  /// Borrows all.
  SocketFollower(const RehearsalPlan& plan, const haptics::Bodies& bodies, EventLog& event_log);

  /// All ticks, in order, made with this command.
  void follow(std::span<const haptics::Tick> ticks, const haptics::Command& command);
  struct Frame {
    std::span<const glm::ivec3> bricks;  ///< of the jaw's grid, changed since the last call
    const haptics::Tick& newest;
    bool is_applied = false;  ///< the newest command was in force in `newest`
    bool waits = false;       ///< for a servo that is stepped
  };
  /// Once a frame. What the servo shall let loose; the serial is the caller's.
  std::optional<haptics::ChipOrder> follow(const Frame& frame);
  /// Looks once more, for the recording, before that is closed.
  void finish(std::span<const glm::ivec3> bricks, const haptics::Tick& newest);

  /// A line when a stitch is confirmed.
  std::optional<std::string> news();
  /// "socket not clean: sharp edges 12 mm"; empty: nothing to say.
  std::string line() const;
  /// Chips, follicle, and marks where sharp edges and pieces of tooth are.
  std::vector<render::Bead> beads() const;
  /// Jaw and pieces that lie in it, in the order of the jaw's grid, of the last frame.
  std::span<const std::uint8_t> solidInMouth() const { return loose_.chips().solid(); }
  /// For a hand that cleans.
  SiteLeft left() const;
  /// None: no piece is out and no chip came loose.
  const std::optional<SocketRecord>& newest() const { return told_; }

 private:
  std::optional<SocketRecord> record() const;
  void tell(double t_s, bool is_last);
  bool isAnyOut() const;

  EventLog& event_log_;
  ChipDesk desk_;
  LooseSite loose_;
  std::optional<SocketWatch> watch_;
  std::optional<SocketRecord> told_;
  std::optional<double> told_s_;
  std::string news_;
};

}  // namespace app
