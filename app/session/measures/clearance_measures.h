// How near the turning bur came to nerve and neighbours (reference/product 4.3): S1 the least clearance of its surface
// with the shaft, when, and force and speed then; S2 the time nearer than 1, 2 and 4 mm to the canal. Over all ticks
// with the drill on, at the place where the bur is felt and cuts. A stream: live and from the file the same ticks give
// the same numbers. One thread; a structure is asked where it can have come nearer than before or into another band: 5
// µs each, then.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/measures/measure_value.h"
#include "assets/proposed.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/clearance.h"

namespace app {

/// Why a clearance is not told where there is nothing to keep off.
inline constexpr std::string_view kNoStructure = "the case has no such structure, or was recorded before it was kept";

/// Kind of the event with what was found live, written at the end of a rehearsal.
inline constexpr char kClearanceEvent[] = "clearance";

/// Where the tool of a tick is felt and cuts.
calibration::Pose<calibration::Patient, calibration::Tool> heldPose(const haptics::Tick& tick);

class ClearanceMeasures {
 public:
  /// Borrowed.
  explicit ClearanceMeasures(const assets::RiskStructures& structures) : structures_(structures) {}

  /// `tool` of that tick.
  void add(const haptics::Tick& tick, const haptics::Tool& tool);

  /// With the force of the model and the speed of the head's centre then.
  struct Least {
    double mm = 0.0, t_s = 0.0, force_N = 0.0;
    std::optional<double> speed_mm_per_s;
  };
  /// None: the drill was not on, or the case has no such structure.
  const std::array<std::optional<Least>, assets::kRiskStructures>& least() const { return least_; }
  std::vector<MeasureValue> values() const;

 private:
  static constexpr std::array kBands_mm{1.0, 2.0, 4.0};
  struct Asked {
    double mm = 0.0, moved_mm = 0.0;  ///< what the surface can have moved since
  };
  bool isSettled(std::size_t structure, const Asked& asked) const;

  const assets::RiskStructures& structures_;
  std::array<std::optional<Least>, assets::kRiskStructures> least_;
  std::array<std::optional<Asked>, assets::kRiskStructures> asked_;
  std::array<double, kBands_mm.size()> in_band_s_{};
  std::optional<calibration::Pose<calibration::Patient, calibration::Tool>> last_;
  double last_s_ = 0.0;  ///< of last_
  haptics::Tool tool_;
  bool turned_ = false;
};

/// Without any structure: each measure with why.
std::vector<MeasureValue> noClearances(std::string_view why);

/// "canal 1.4 mm at 3:12, second molar 0.6 mm at 2:10"; empty: nothing was told.
std::string clearancesInWords(const ClearanceMeasures& measures, const assets::Proposed& proposed = {});
/// {"canal": {"mm": 1.4, "t_s": 192.3}, …} with all digits.
std::string clearanceText(const ClearanceMeasures& measures);

}  // namespace app
