// What was seen of the work (reference/product 4: S7, M10): eyes and the other hand's mirror as recorded, or a usual
// surgeon's eyes, over the removal of a whole session (sight.h). A stream over commands, events and ticks; one thread.
// Frame P, mm, s.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "app/session/measures/measure_value.h"
#include "app/session/measures/session_case.h"
#include "app/session/measures/sight.h"
#include "app/session/session_start.h"
#include "app/session/session_writer.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

class Onlooker {
 public:
  /// In order, each before the ticks it holds for.
  void add(const haptics::Command& in_force, double t_s);
  /// Of eyes or of the second hand; others are not looked at.
  void add(const SessionEvent& event, double t_s);
  void add(const haptics::Tick& tick);

  struct Session {
    const RemovalClock* clock;  ///< null: the bone at the end is not known
    const StoredStart& start;
    std::span<const std::uint8_t> after;
    const SessionCase& about;
    std::optional<double> out_s;  ///< of the tooth
  };
  /// After the last tick.
  std::vector<MeasureValue> values(const Session& session) const;

 private:
  std::string_view whyNoMirror() const;

  std::vector<EyesFrom> eyes_;
  std::vector<HeldFrom> held_;
  SecondHandTrack second_hand_;
  std::vector<WorkingEnd> ends_;
  bool has_second_hand_ = false, has_mirror_ = false;
};

std::vector<MeasureValue> noSight(std::string_view why);

}  // namespace app
