// An experiment with a participant at the window: keys 1 and 2 apply the first or second stimulus, as often as wanted;
// A and B answer which was harder, once both were felt; then a pause and the next trial. Blind: shows no law, force or
// value. Measures use every tick under the command of the stimulus. Main thread; time is that of the ticks.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "app/procedure/procedure.h"
#include "app/psychophysics/experiment.h"

namespace app {

class TrialRunner final : public Procedure {
 public:
  using OnTrial = std::function<void(const TrialRecord&)>;

  /// `experiment` is borrowed and run to its end.
  TrialRunner(Experiment& experiment, const ProbeSite& site, double between_trials_s, OnTrial on_trial);

  bool takeKey(char key) override;
  std::optional<haptics::Command> follow(std::span<const haptics::Tick> ticks) override;
  ProcedureMessages messages() const override;
  bool isOver() const override { return is_over_; }

 private:
  void begin(int interval);
  std::optional<haptics::Command> followTick(const haptics::Tick& tick);
  std::string participantText() const;
  void answer(bool second_harder);

  Experiment& experiment_;
  ProbeSite site_;
  double between_trials_s_;
  OnTrial on_trial_;
  std::vector<ProbeSample> felt_[2];  ///< latest probing of each stimulus
  int interval_ = 0;
  bool changed_ = true, is_over_ = false, pausing_ = false;
  std::uint64_t serial_before_ = 0;  ///< of the command in force when the stimulus was requested
  double t_s_ = 0.0, since_s_ = 0.0, pause_ends_s_ = 0.0;
  std::string hint_;
};

}  // namespace app
