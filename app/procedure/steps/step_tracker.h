// Follows a procedure's steps over the ticks of a rehearsal: which step is in hand, what it still lacks, what counts as
// an error in it. Pure: ticks and facts in, news out. A step that was met stays met, also after an undo. A tooth that
// is parted or out cannot be put back by hand: steps before a later one whose rule says so are then left as omitted.
// Main thread; below a microsecond a tick.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/procedure/steps/step_plan.h"
#include "app/session/step_event.h"
#include "haptics/servo/tick.h"

namespace app {

enum class StepError : std::uint8_t {
  neighbour,
  canal,
  soft_tissue,
  dry,
  fulcrum,
  wrong_instrument,
  near_nerve,
  pressed_hard,
  pulled_hard,
  bone_beyond_limit
};
inline constexpr std::size_t kStepErrors = 10;
/// In files and summaries: "cutting dry".
std::string_view wordsOf(StepError error);

/// The socket as it was looked at last, after a piece came out.
struct SocketFacts {
  double chips_mm3 = 0.0, follicle_left = 0.0, edges_mm = 0.0;
  bool is_clean = false;
  int stitches = 0;
};

/// The flap, where the rehearsal began with the gum closed.
struct FlapFacts {
  double full_incision_mm = 0.0, raised_share = 0.0;
  bool is_held = false;
};

/// What the tick alone does not say. None: not known.
struct StepFacts {
  StepInstrument in_hand = StepInstrument::bur;
  bool irrigating = true;
  std::optional<double> gutter_removed, crown_bared;  ///< shares
  std::optional<double> bridge_mm;                    ///< the thinnest
  std::optional<double> nerve_mm;                     ///< of the bur to the wall of the mandibular canal
  std::optional<FlapFacts> flap;
  std::optional<SocketFacts> socket;
};

class StepTracker {
 public:
  explicit StepTracker(const StepPlan& plan);

  void follow(const haptics::Tick& tick, const StepFacts& facts);
  /// A touch that was counted elsewhere; nothing where the step in hand allows it.
  void blame(StepError error);
  /// The step in hand, by hand. False: there is none.
  bool skip();
  /// At the end of the rehearsal: what is open, or was not reached, is reported as that.
  void finish();

  /// None: all have ended.
  std::optional<std::size_t> current() const;
  const StepPlan& plan() const { return plan_; }
  const std::vector<StepRecord>& records() const { return records_; }
  /// At work in the newest tick, and the step in hand does not name it and counts that as an error.
  bool usesOtherInstrument() const;
  /// A fact that some step from the current one on asks for.
  bool asksForBone() const;
  /// What the step in hand lacks: "crown bared 34 of 70 %". Empty: nothing, or no step.
  std::string missing() const;
  /// What was given since the last call, for the surgeon.
  std::vector<std::string> takeGiven();
  /// Texts of kStepEvent since the last call.
  std::vector<std::string> takeEvents();

 private:
  void begin(std::size_t step);
  void end(StepState state);
  void passOver(std::size_t next);
  void followErrors(const haptics::Tick& tick, const StepFacts& facts);
  void note(StepError error);

  StepPlan plan_;
  std::vector<StepRecord> records_;
  std::size_t current_ = 0;
  double now_s_ = 0.0;
  std::optional<haptics::Tick> newest_;
  StepFacts facts_;
  std::array<double, kStepErrors> last_s_;  ///< of each error's last tick
  std::vector<std::string> events_, given_;
};

/// Bone removed, mm³, of any tissue that is bone; and of teeth.
double boneRemoved_mm3(const haptics::Tick& tick);
double toothRemoved_mm3(const haptics::Tick& tick);

}  // namespace app
