// What the forceps do, from every tick: how long pieces were held, the largest pull, how much ligament is torn, and
// what came out, less what was undone; in words for the surgeon as it happens, and for the summary. Main thread, once a
// frame; microseconds a tick.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "haptics/servo/tick.h"

namespace app {

class GripLog {
 public:
  struct Told {
    std::string line;
    bool is_event = false;  ///< to be recorded, too
  };

  /// `ticks` in order. `forceps_in_hand`, `ready`: now. `volume_mm3`: of a piece, 0: not known.
  std::vector<Told> follow(std::span<const haptics::Tick> ticks, bool forceps_in_hand, bool ready,
                           const std::function<double(std::size_t)>& volume_mm3);

  /// "412 and 324 mm³ taken out, held for 0:23, 140 N at most, ligament torn"; empty: nothing was held.
  std::string summary() const;

 private:
  std::optional<Told> follow(const haptics::Tick& tick, std::size_t piece,
                             const std::function<double(std::size_t)>& volume_mm3);

  double held_s_ = 0.0, most_N_ = 0.0, torn_share_ = 0.0;
  struct Out {
    std::size_t piece = 0;
    double mm3 = 0.0;
  };
  std::vector<Out> out_;
  bool was_closed_ = false;
  std::array<int, haptics::kMaxPieces> torn_told_{};  ///< quarters of the ligament
};

/// "not ready", "open", "torn 40 %", "loose": where the drill's speed stands.
std::string forcepsText(const haptics::Tick& tick, bool ready);

}  // namespace app
