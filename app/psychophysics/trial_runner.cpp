#include "app/psychophysics/trial_runner.h"

#include <algorithm>

namespace app {
namespace {

constexpr double kTouch_N = 0.05;

bool touched(const std::vector<ProbeSample>& felt) {
  return std::ranges::any_of(felt, [](const ProbeSample& sample) { return sample.force_N > kTouch_N; });
}

}  // namespace

TrialRunner::TrialRunner(Experiment& experiment, const ProbeSite& site, double between_trials_s, OnTrial on_trial)
    : experiment_(experiment),
      site_(site),
      between_trials_s_(between_trials_s),
      on_trial_(std::move(on_trial)),
      is_over_(!experiment.next()) {}

void TrialRunner::begin(int interval) {
  interval_ = interval;
  felt_[interval].clear();
  changed_ = true;
  hint_.clear();
}

bool TrialRunner::takeKey(char key) {
  const bool is_mine = key == '1' || key == '2' || key == 'A' || key == 'B';
  if (!is_mine || pausing_ || is_over_) return is_mine;
  if (key == '1' || key == '2') {
    begin(key - '1');
  } else if (!touched(felt_[0]) || !touched(felt_[1])) {
    hint_ = "   feel both first";
  } else {
    answer(key == 'B');
  }
  return true;
}

void TrialRunner::answer(bool second_harder) {
  on_trial_(experiment_.answer(second_harder, measuresOf(felt_[0]), measuresOf(felt_[1]), t_s_ - since_s_));
  felt_[0].clear(), felt_[1].clear();
  is_over_ = !experiment_.next();
  pausing_ = !is_over_;
  pause_ends_s_ = t_s_ + between_trials_s_;
}

std::optional<haptics::Command> TrialRunner::follow(std::span<const haptics::Tick> ticks) {
  std::optional<haptics::Command> wanted;
  for (const haptics::Tick& tick : ticks)
    if (const auto command = followTick(tick)) wanted = command;
  return wanted;
}

std::optional<haptics::Command> TrialRunner::followTick(const haptics::Tick& tick) {
  t_s_ = tick.t_s;
  if (is_over_) return std::nullopt;
  if (pausing_) {
    if (t_s_ < pause_ends_s_) return std::nullopt;
    pausing_ = false;
    since_s_ = t_s_;
    begin(0);
  }
  const haptics::Command command = experiment_.commandOf(interval_);
  if (changed_) {
    changed_ = false;
    serial_before_ = tick.command_serial;
    return command;
  }
  if (tick.command_serial <= serial_before_) return std::nullopt;
  // Depth along the approach of the bur, from the first contact.
  const glm::dvec3 touch_P = site_.surface_P.mm + command.tool.head.radius_mm * site_.outward_P.xyz;
  felt_[interval_].push_back({glm::dot(touch_P - tick.hand.X_PT.translation_mm, site_.outward_P.xyz),
                              glm::dot(tick.commanded_force_P_N.xyz, site_.outward_P.xyz)});
  return std::nullopt;
}

std::string TrialRunner::participantText() const {
  if (is_over_) return "thank you, that was all";
  const std::string trial =
      "trial " + std::to_string(experiment_.trial()) + " of at most " + std::to_string(experiment_.most());
  if (pausing_) return trial + "   lift the bur, please";
  return trial + (interval_ == 0 ? "   you feel A" : "   you feel B") +
         "   1: feel A   2: feel B   harder was: A or B" + hint_;
}

/// Double blind: spectators see no law or value either.
ProcedureMessages TrialRunner::messages() const {
  if (is_over_) return {participantText(), "all trials answered"};
  const char* const felt = touched(felt_[0]) ? (touched(felt_[1]) ? "A and B" : "A") : touched(felt_[1]) ? "B" : "none";
  return {participantText(),
          "trial " + std::to_string(experiment_.trial()) + (pausing_ ? ", pause" : std::string(", felt: ") + felt)};
}

}  // namespace app
