// Says one thing at a time about how the hand works, by rules in a file that a supervisor can edit
// (reference/product 4.5). Rules look at the samples of measures and at the strokes found in them; what is said has a
// pause before it, and the same is not said again soon. Never in assessment. A stream: one thread; 0.1 µs a tick.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/session/measures/strokes.h"

namespace app {

enum class CoachSign : std::uint8_t {
  force,
  plunging,
  deep_stroke,
  dry,
  lingering,
  near_structure,
  wrong_step,
  out_of_sight
};
/// In files, in the order of the values.
inline constexpr std::array<std::string_view, 8> kCoachSigns{
    "force", "plunging", "deep-stroke", "dry", "lingering", "near-structure", "wrong-step", "out-of-sight"};

struct CoachRule {
  CoachSign looks_for = CoachSign::force;
  double most = 0.0;       ///< N, or a ratio; not of dry and lingering
  double within_mm = 0.0;  ///< of a structure, for near_structure alone
  double for_s = 0.0;      ///< seen so long without a break; not of plunging and deep strokes
  std::string says;
};

/// What the sample alone does not say.
struct CoachContext {
  std::optional<double> nearest_mm = {};  ///< of the structures that are to be kept off; none: none is known
  bool is_other_instrument = false;       ///< at work, and not the procedure's for the step in hand
  bool is_out_of_sight = false;           ///< what is removed is hidden from both eyes (measures/sight_lines.h)
};

struct CoachRules {
  double pause_s = 3.0, again_s = 15.0;
  std::vector<CoachRule> rules;  ///< the most important first
};

class Coach {
 public:
  static constexpr double kWindow_s = 2.0;        ///< of plunging
  static constexpr double kLeastWay_mm = 0.8;     ///< into the bone in it
  static constexpr double kMoves_mm_per_s = 1.0;  ///< along the bone; slower is lingering

  explicit Coach(CoachRules rules);
  Coach(const Coach&) = delete;
  Coach& operator=(const Coach&) = delete;

  void add(const WorkSample& sample, const CoachContext& context = {});
  /// What is to be said now; it counts as said.
  std::optional<std::string> take();

 private:
  void addWay(const WorkSample& sample);
  bool isSeen(const CoachRule& rule, const WorkSample& sample) const;

  CoachRules rules_;
  StrokeFinder strokes_;
  std::vector<double> seen_s_;  ///< by rule, without a break
  std::vector<std::optional<double>> said_at_s_;
  std::vector<char> is_due_;
  std::optional<double> last_s_;  ///< anything was said
  double now_s_ = 0.0;
  CoachContext context_;
  double deepest_ = 0.0;  ///< of the strokes that ended with this sample, over the radius
  // Ways of the last kWindow_s of drilling, in tenths of it.
  static constexpr std::size_t kParts = 10;
  std::array<double, kParts> into_mm_{}, along_mm_{}, part_s_{};
  std::size_t part_ = 0;
};

}  // namespace app
