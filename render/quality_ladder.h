// Adapts the rendering quality to the machine: a ladder of steps, changed by measured frame times. Down quickly when
// frames are late, up slowly and only if the better step is predicted to be in time; each failed climb doubles the wait
// for the next. What a better step costs is learned where the ladder went down: a machine whose frame time hardly
// depends on the step would else stay at the worst for ever after a busy moment. Does not change while `may_change` is
// false, since a change during a stroke distracts the user. Has no clock: frame times are passed in. Any one thread;
// sorts nine numbers a frame. Relative costs of the steps: reference/rendering 6 (shading) and 2a (step, size).
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string_view>

#include "render/frame.h"

namespace render {

struct QualityStep {
  std::string_view description;  ///< for the status line
  Quality quality;
  double climb_cost;  ///< frame time of the next better step relative to this one, on a machine that only draws
};

/// Best first.
inline constexpr std::array<QualityStep, 7> kQualitySteps = {{
    {"full", {Antialias::edges, true, true, 0.5, 1}, 1.0},
    {"no lamp shadow", {Antialias::edges, true, false, 0.5, 1}, 1.5},
    {"no smooth edges", {Antialias::none, true, false, 0.5, 1}, 1.4},
    {"no ambient occlusion", {Antialias::none, false, false, 0.5, 1}, 1.25},
    {"coarse steps", {Antialias::none, false, false, 1.0, 1}, 1.3},
    {"half resolution", {Antialias::none, false, false, 1.0, 2}, 4.0},
    {"third resolution", {Antialias::none, false, false, 1.0, 3}, 2.25},
}};

class QualityLadder {
 public:
  /// `budget_s`: longest drawing time of a frame. Starts at `first_step`.
  explicit QualityLadder(double budget_s, int first_step = 0);

  /// After each frame: its drawing time, and whether the quality may change now. Returns the new step if it changed.
  std::optional<int> add(double frame_s, bool may_change);

  int step() const { return step_; }
  const Quality& quality() const { return kQualitySteps[static_cast<std::size_t>(step_)].quality; }
  std::string_view description() const { return kQualitySteps[static_cast<std::size_t>(step_)].description; }

 private:
  double typical_s() const;
  std::optional<int> goTo(int step);
  void learnCost(double typical_s);

  double budget_s_;
  int step_;
  std::deque<double> recent_s_;
  double calm_s_ = 0.0;   ///< how long a better step would have been in time
  double climb_after_s_;  ///< calm_s_ required for the next climb
  double since_climb_s_ = 1e9;
  std::array<double, kQualitySteps.size()> climb_cost_;  ///< as learned, at most those of the table
  struct Descent {
    int from = 0;
    double left_at_s = 0.0;  ///< frame time
  };
  std::optional<Descent> descent_;  ///< the newest, until what it saved is measured
};

}  // namespace render
