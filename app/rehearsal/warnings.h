// Warnings for the surgeon, in the picture: one table of conditions on the newest tick, words and order. A warning
// stays a moment after its cause is over, so that a touch of a few milliseconds can be read. Main thread, once a frame;
// some microseconds.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/view/head_up_line.h"
#include "assets/patient.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

/// What the conditions are about.
struct Situation {
  const haptics::Tick& tick;
  const haptics::Command& command;
  bool has_motors = false;
  bool recording_ended = false;            ///< early
  std::optional<int> neighbour{};          ///< FDI number of another tooth that the bur touches
  std::optional<double> canal_mm{};        ///< from the tool to the mandibular canal, clearance_watch.h; below 0 inside
  std::optional<double> jaw_N_per_mm2{};   ///< of an elevator (app/procedure/jaw_stress)
  std::optional<double> root_N_per_mm2{};  ///< of forceps (app/procedure/root_stress)
  bool is_crown = false;                   ///< the same is of the crown
  bool is_blind = false;                   ///< distances are counted and not told
  std::optional<double> below_cusp_mm{};   ///< of a bur in the crown of a lower molar (root_canal/access_watch)
};

/// `tick` newest. Cost: the voxels around the bur, while it touches a tooth.
Situation situationOf(const haptics::Tick& tick, const haptics::Command& command, const assets::Patient& patient,
                      bool has_motors, bool recording_ended);

/// Time with the bur in bone or tooth, from every tick.
struct WorkTimes {
  double cutting_s = 0.0, dry_s = 0.0;

  void add(const haptics::Tick& tick, bool irrigating) {
    if (!tick.drilling || tick.depth_mm <= 0.0) return;
    cutting_s += tick.dt_s;
    if (!irrigating) dry_s += tick.dt_s;
  }
};

class Warnings {
 public:
  /// The most important first. `tick` may be older than that of the last call (a replay), which begins again.
  std::vector<HeadUpWarning> update(const Situation& now);
  /// How often a warning began, in the order of the table: for the summary.
  struct Count {
    std::string name;
    int times = 0;
  };
  std::vector<Count> counts() const;

 private:
  static constexpr std::size_t kRows = 21;
  struct State {
    double last_s = -1e9;
    std::string words;
    int times = 0;
  };
  std::array<State, kRows> states_;
};

}  // namespace app
