// The servo on the initial bone of a session, driven by its recorded hand and commands, tick by tick. No clock, device
// or thread; takes the CPU time of the recorded steps. Frame P. Any one thread but the servo. What orders of a session
// need beside the command (plans of splits and breaks, sites, chips) is made again from the bodies as they are: an
// order holds for these or not at all. With Keeping::all they are kept, 5 to 10 MB a site, so that state() can be
// restored.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/session/session_writer.h"
#include "haptics/body/bodies.h"
#include "haptics/body/chip_search.h"
#include "haptics/ligament/piece_site.h"
#include "haptics/servo/servo.h"

namespace app {

/// The first quantity in which a replayed tick differs from the recorded one; none: every bit is the same.
std::optional<std::string> differenceOf(const haptics::Tick& recorded, const haptics::Tick& again);

class Rerun {
 public:
  enum class Keeping { what_is_in_use, all };

  /// Borrows bodies and soft tissue.
  Rerun(haptics::Bodies& bodies, const assets::SoftTissueField& soft_tissue, std::vector<SessionCommand> commands,
        Keeping keeping = Keeping::what_is_in_use);

  /// Commands come while it runs, each before the tick that it is first in force in: what a later one may need is kept.
  /// Before the first step.
  void expectMore();
  void add(std::span<const SessionCommand> commands) {
    commands_.insert(commands_.end(), commands.begin(), commands.end());
  }

  /// Selects the command of this tick. Returns why the tick cannot be compared: lost ticks, or a missing command.
  std::optional<std::string> prepare(const haptics::Tick& recorded);
  haptics::Tick step(const haptics::Tick& recorded);
  const haptics::Command& command() const { return command_; }

  /// All but the bodies and Servo::Memory. Holds for this rerun alone.
  struct State {
    haptics::Servo servo;  ///< without its memory
    haptics::Command command;
    std::size_t next = 0;
    std::uint64_t next_index = 0;
    bool grips = false;
    /// Of the sites in force.
    std::array<std::optional<haptics::PieceState>, haptics::kMaxPieces> pieces;
  };
  State state();
  void restore(const State& state);
  /// Calls `work` with the arrays of the servo's memory as bytes.
  template <class Work>
  void withMemory(const Work& work) {
    haptics::Servo::Memory memory = servo_->takeMemory();
    // Bytes that are copied away and back are these values again.
    static_assert(std::is_trivially_copyable_v<std::decay_t<decltype(memory.strokes.saved[0])>> &&
                  std::is_trivially_copyable_v<std::decay_t<decltype(memory.strokes.saved_in[0])>> &&
                  std::is_trivially_copyable_v<std::decay_t<decltype(memory.luxations[0])>> &&
                  std::is_trivially_copyable_v<std::decay_t<decltype(memory.waiting[0])>>);
    const std::array arrays{std::as_writable_bytes(std::span(memory.strokes.saved)),
                            std::as_writable_bytes(std::span(memory.strokes.saved_in)),
                            std::as_writable_bytes(std::span(memory.luxations)),
                            std::as_writable_bytes(std::span(memory.waiting))};
    work(arrays);
    servo_->giveMemory(std::move(memory));
  }

  /// Bricks of the jaw's grid that have changed since the last call, also those that a search for chips has taken from
  /// the bodies; only with Keeping::all.
  std::vector<glm::ivec3> takeChanged();
  /// Of the sites that are kept; 0 without Keeping::all.
  std::size_t siteBytes() const;

 private:
  struct MadeSite {
    std::unique_ptr<haptics::PieceSite> site;
    haptics::PieceState first;  ///< when it was made
  };
  const haptics::SplitPlan* planFor(const haptics::SplitOrder& order);
  const haptics::BreakPlan* breakFor(const haptics::BreakOrder& order);
  const haptics::ChipPlan* chipsFor(const haptics::ChipOrder& order);
  haptics::PieceSite* siteFor(const haptics::SiteOrder& order);
  std::unique_ptr<haptics::PieceSite> newSite(const haptics::SiteOrder& order);
  void collectChanged();

  haptics::Bodies& bodies_;
  Keeping keeping_;
  haptics::SocketSource sockets_;
  std::optional<haptics::DistanceField> first_socket_;  ///< none: not needed yet
  std::optional<haptics::Servo> servo_;
  std::vector<SessionCommand> commands_;
  // By the number of the command with the order; null: it does not hold.
  std::map<std::size_t, std::unique_ptr<haptics::SplitPlan>> splits_;
  std::map<std::size_t, std::unique_ptr<haptics::BreakPlan>> breaks_;
  std::map<std::size_t, std::unique_ptr<haptics::ChipPlan>> chips_;
  std::map<std::size_t, MadeSite> kept_sites_;                                                   ///< with Keeping::all
  std::array<std::deque<std::unique_ptr<haptics::PieceSite>>, haptics::kMaxPieces> used_sites_;  ///< else
  std::optional<haptics::FirstBytes> first_;  ///< none: no chips are looked for, or search_ has them
  std::optional<haptics::ChipSearch> search_;
  std::vector<glm::ivec3> unsearched_, changed_;  ///< bricks of the jaw's grid, each once
  haptics::Command command_;
  std::size_t next_ = 0;
  std::uint64_t next_index_ = 0;
  bool grips_ = false;
};

}  // namespace app
