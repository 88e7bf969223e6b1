// Which quality a machine can keep up with: a ladder of steps, climbed and descended by measured frame times. Down soon
// when frames come late, up slowly and only where the better step should still be in time; a climb that fails makes the
// next one wait twice as long. Never changes while it must not (`may_change`): a image that turns in the middle of a
// stroke distracts the hand. Fed with times, so it has no clock. Any one thread; a sort of a dozen numbers a frame.
// Costs of steps relative to each other: reference/rendering 6 (shading) and 2a (step, size); what is measured decides.
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
  double climb_cost;  ///< how many times the time the next better step takes
};

/// Best first.
inline constexpr std::array<QualityStep, 7> kQualitySteps = {{
    {"full", {Antialias::edges, true, true, 0.5, 1}, 1.0},
    {"no lamp shadow", {Antialias::edges, true, false, 0.5, 1}, 1.5},
    {"no smooth edges", {Antialias::none, true, false, 0.5, 1}, 1.4},
    {"no shading of hollows", {Antialias::none, false, false, 0.5, 1}, 1.25},
    {"coarse steps", {Antialias::none, false, false, 1.0, 1}, 1.3},
    {"half resolution", {Antialias::none, false, false, 1.0, 2}, 4.0},
    {"third resolution", {Antialias::none, false, false, 1.0, 3}, 2.25},
}};

class QualityLadder {
 public:
  /// `budget_s`: how long a frame may take to draw. Starts at `first_step`.
  explicit QualityLadder(double budget_s, int first_step = 0);

  /// After each frame: how long it took to draw, and whether the quality may change now. The new step, if it did.
  std::optional<int> add(double frame_s, bool may_change);

  int step() const { return step_; }
  const Quality& quality() const { return kQualitySteps[static_cast<std::size_t>(step_)].quality; }
  std::string_view description() const { return kQualitySteps[static_cast<std::size_t>(step_)].description; }

 private:
  double typical_s() const;
  std::optional<int> goTo(int step);

  double budget_s_;
  int step_;
  std::deque<double> recent_s_;
  double calm_s_ = 0.0;   ///< since when a better step would have been in time
  double climb_after_s_;  ///< so much calm is asked for
  double since_climb_s_ = 1e9;
};

}  // namespace render
