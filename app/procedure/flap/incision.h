// The incision of a blade as it is recorded: points on the gum's surface over the blade's tip, half a millimetre apart,
// each with the greatest depth and whether the tip met bone or tooth there. The place is smoothed over 30 ms and a
// point is added only where the cut has not been yet, so that neither tremor nor a second stroke in the same cut makes
// it longer. Frame P, mm, s. From poses on a grid of simulated time; any thread; microseconds a step.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/procedure/flap/gum_chart.h"

namespace app {

struct IncisionPoint {
  ChartPlace at;
  glm::dvec3 at_P_mm{0.0};  ///< on the gum
  double depth_mm = 0.0;
  bool is_full = false;  ///< down to bone or tooth
  int stroke = 0;
};

class Incision {
 public:
  static constexpr double kPoint_mm = 0.5;
  /// Nearer to older points the blade is in the cut that is there.
  static constexpr double kSameCut_mm = 1.0;
  static constexpr double kLeastDepth_mm = 0.25;
  static constexpr double kSmoothing_s = 0.03;

  /// Borrows the chart.
  explicit Incision(const GumChart& chart) : chart_(chart) {}

  struct Blade {
    glm::dvec3 tip_P_mm{0.0};
    bool meets_bone = false;  ///< or tooth, at any time since the last step
  };
  /// None: no blade is in the hand. True: something was cut.
  bool follow(const std::optional<Blade>& blade, double dt_s);

  const std::vector<IncisionPoint>& points() const { return points_; }
  double length_mm() const;
  /// Share of the length that goes down to the bone; 0 without an incision.
  double fullShare() const;

 private:
  void add(const glm::dvec3& at_P_mm);
  std::optional<std::size_t> nearest(const glm::dvec3& p_P_mm, double reach_mm) const;
  bool deepen(const glm::dvec3& p_P_mm, double depth_mm, bool is_full);

  const GumChart& chart_;
  std::vector<IncisionPoint> points_;
  std::optional<glm::dvec3> smooth_P_mm_;  ///< while the blade is in the gum
  glm::dvec3 last_P_mm_{0.0};              ///< the blade's newest place in it
  bool goes_on_ = false;                   ///< the newest point was made or passed by this stroke
  int strokes_ = 0;
};

}  // namespace app
