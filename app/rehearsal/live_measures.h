// The main measures during a rehearsal, for the instructor: by the library that measures the recording later, from the
// same ticks and commands, so the numbers at the end, an event of the recording, are those of molar metrics but for the
// ticks after the last frame. The bone's surface is found on a worker; ticks wait for it. Main thread, once a frame:
// 2 µs a tick, at most kMostTicks of those that waited.
#pragma once

#include <deque>
#include <future>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/session/measures/clearance_measures.h"
#include "app/session/measures/hand_work.h"
#include "app/session/measures/original_surface.h"
#include "assets/ct_volume.h"
#include "haptics/servo/command.h"

namespace app {

/// Kind of the event with what was found live, written at the end of a rehearsal: {"M1.on": 12.3, …}.
inline constexpr char kMeasuresEvent[] = "measures";

class LiveMeasures {
 public:
  static constexpr std::size_t kMostTicks = 5000;

  /// Borrows the volume, as it lies at the start. `waits`: for the surface.
  LiveMeasures(const assets::CtVolume& ct, bool waits);

  /// All ticks, in order; `command` in force now, with the number that ticks tell of it.
  void follow(std::span<const haptics::Tick> ticks, const haptics::Command& command, std::uint64_t serial);
  /// What waits is measured, and the last stroke ends.
  void finish();

  /// Those that an instructor follows, of all ticks so far that have been measured.
  std::vector<MeasureValue> values() const;
  /// For the event.
  std::string text() const;

 private:
  struct Given {
    haptics::Tick tick;
    std::size_t command;  ///< in commands_
  };
  void measure(std::size_t most);

  HandWork work_;
  std::future<std::unique_ptr<OriginalSurface>> coming_;
  std::unique_ptr<OriginalSurface> surface_;
  struct Numbered {
    std::uint64_t serial;
    haptics::Command command;
  };
  std::vector<Numbered> commands_;
  std::deque<Given> waiting_;
};

}  // namespace app
