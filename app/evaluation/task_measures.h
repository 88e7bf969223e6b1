// The measures of one task as they grow, for its rules: streams over the ticks from the task's first on, by the library
// that measures recordings (session/measures). Live and from the file the same ticks and commands give the same bits.
// Frame P; mm, N, s. One thread; 1 to 5 µs a tick, by what is asked for.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/evaluation/rule.h"
#include "app/session/measures/clearance_measures.h"
#include "app/session/measures/hand_work.h"
#include "app/session/measures/near_work.h"
#include "app/session/measures/tissue_work.h"
#include "assets/risk_structures.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

/// Those that rules may name: `time`, `pieces`, `pieces_out`, O1.removed, and of M1, M2, S1 to S5, S8 to S10 those that
/// a tick decides; and those of the bone as it is in a tick, since the rehearsal began: O1 to O11
/// (session/measures/outcome).
const std::vector<RuleMeasure>& ruleMeasures();
/// It needs the bone of its tick, which somebody else has to tell.
bool needsBone(std::string_view id);
/// The value of such a measure in a tick; empty: nobody tells.
using BoneValue = std::function<std::optional<double>(std::string_view id)>;

class TaskMeasures {
 public:
  /// Borrows the structures. `ids`: those that will be asked for.
  TaskMeasures(const assets::RiskStructures& structures, std::vector<std::string> ids);

  /// `in_force` in that tick, `bone` of it.
  void add(const haptics::Tick& tick, const haptics::Command& in_force, const BoneValue& bone = {});
  /// None: not known yet, or not asked for.
  std::optional<double> value(std::string_view id) const;

 private:
  bool asks(std::string_view beginning) const;
  void read(const std::vector<MeasureValue>& values);

  std::vector<std::string> ids_;
  std::vector<std::optional<double>> values_;  ///< of ids_
  std::vector<bool> needs_bone_;               ///< alike
  bool asks_clearance_, asks_near_, asks_tissue_, asks_hand_;
  double time_s_ = 0.0, removed_mm3_ = 0.0;
  ClearanceMeasures clearance_;
  NearWork near_;
  TissueWork tissue_;
  HandWork hand_;
};

}  // namespace app
