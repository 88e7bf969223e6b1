// What forceps and elevators do, from every tick: how long they worked on pieces, the largest pull and torque, what a
// neighbouring tooth had to bear, how much ligament is torn, which bridges broke, and what came out, less what was
// undone; in words for the surgeon as it happens, and for the summary. Main thread, once a frame; microseconds a tick.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

class LuxationLog {
 public:
  struct Told {
    std::string line;
    bool is_event = false;     ///< to be recorded, too
    bool by_elevator = false;  ///< not by forceps
  };

  /// `ticks` in order. `forceps_in_hand`, `ready`: now. `volume_mm3`: of a piece, 0: not known.
  std::vector<Told> follow(std::span<const haptics::Tick> ticks, bool forceps_in_hand, bool ready,
                           const std::function<double(std::size_t)>& volume_mm3);

  /// "412 and 324 mm³ taken out, held for 0:23, …, levered for 0:40, …, ligament torn"; empty: nothing was moved.
  std::string summary() const;

 private:
  std::optional<Told> follow(const haptics::Tick& tick, std::size_t piece,
                             const std::function<double(std::size_t)>& volume_mm3);

  void followLigament(const haptics::Tick& tick, std::size_t piece, bool by_elevator, std::vector<Told>& told);
  void followBridge(const haptics::BrokenBridge& broken, bool by_elevator, std::vector<Told>& told);
  void followFulcrum(const haptics::Tick& tick, std::vector<Told>& told);

  double held_s_ = 0.0, most_N_ = 0.0, torn_share_ = 0.0;
  double levered_s_ = 0.0, most_Nmm_ = 0.0, most_fulcrum_N_ = 0.0;
  /// A neighbouring tooth is the fulcrum: since when, its largest load.
  double fulcrum_s_ = 0.0, fulcrum_N_ = 0.0;
  int bridges_broken_ = 0;
  struct Out {
    std::size_t piece = 0;
    double mm3 = 0.0;
  };
  std::vector<Out> out_;
  bool was_closed_ = false;
  std::array<int, haptics::kMaxPieces> torn_told_{};  ///< quarters of the ligament
};

/// "not ready", "open" or "free", "torn 40 %", "bridge 60 %" (of what breaks it), "loose": where the drill's speed
/// stands.
std::string luxationText(const haptics::Tick& tick, const haptics::Tool& tool, bool ready);

}  // namespace app
