// What the bur did to tissue (reference/product 4.3, 4.4): S8 time with more force of the model than its tissue needs,
// S9 turning bur on soft tissue, S11 heat of the bone, indicative; M9 changes of bur, and the share of bone cut with
// the size that the plan is made for. Frame P; mm, N, s, K. A stream: live and from the file the same ticks give the
// same numbers. One thread; 0.1 µs a tick.
//   S8   bone above 12.5 N (mean peak of 20 operators, R31), tooth above 5.9 N (sectioning, R54)
//   S11  dT/dt = (eta F v - G dT) / C a cell of 1 mm, v the bur's surface speed: eta 0.05, G 0.2 W/K wet and 0.02 dry,
//        C 2.5 mJ/K (bone); solved in closed form over a tick. Our defaults
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "app/session/measures/measure_value.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

/// dT of one place over a tick with constant power and cooling.
struct HeatedCell {
  double t_s = 0.0, over_K = 0.0;
  /// Cools until `t_s`, then is heated for `dt_s`; W, W/K.
  void step(double now_s, double dt_s, double power_W, double cooling_W_per_K);
};

class TissueWork {
 public:
  static constexpr double kBoneMost_N = 12.5, kToothMost_N = 5.9;
  static constexpr double kHeatShare = 0.05, kWet_W_per_K = 0.2, kDry_W_per_K = 0.02, kCell_J_per_K = 2.5e-3;

  /// Of that tick.
  void add(const haptics::Tick& tick, const haptics::Command& in_force);
  /// `planned_radius_mm`: of the bur that the plan is made for; none: no plan.
  std::vector<MeasureValue> values(std::optional<double> planned_radius_mm) const;

 private:
  void heat(const haptics::Tick& tick, const haptics::Command& in_force);

  double bone_s_ = 0.0, tooth_s_ = 0.0, soft_s_ = 0.0;
  int soft_times_ = 0;
  double last_soft_s_ = -1e9;
  bool drilled_ = false;
  std::unordered_map<std::uint64_t, HeatedCell> cells_;
  double hottest_K_ = 0.0;
  std::optional<double> hottest_s_;
  std::optional<haptics::Tool> bur_;
  int changes_ = 0;
  struct BySize {
    double radius_mm = 0.0, bone_mm3 = 0.0;
  };
  std::vector<BySize> sizes_;
};

}  // namespace app
