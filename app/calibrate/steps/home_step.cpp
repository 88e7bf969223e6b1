// The device finds its zero in its inkwell, and gets time to settle. One thread.

#include <algorithm>

#include "app/calibrate/steps/step.h"

namespace app {
namespace {

constexpr double kDocked_s = 0.5;
constexpr double kDoubted_s = 0.3;

class HomeStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override {
    phase_ = Phase::to_inkwell;
    seen_ = false;
    settled_s_ = 0.0;
  }

  StepResult update(const StylusSample& sample, Press press, double) override {
    if (press == Press::long_press) return StepResult::refused("The device was not homed: it cannot be calibrated.");
    const double passed_s = seen_ ? std::max(0.0, sample.t_s - since_s_) : 0.0;
    seen_ = true;

    switch (phase_) {
      case Phase::to_inkwell: {
        const bool is_home = sample.valid && (sample.docked || !context_.plan.has_inkwell);
        if (press == Press::short_press && context_.plan.has_inkwell && !sample.docked)
          context_.announcements.refuse("The stylus is not in its inkwell: push it home.");
        else if (press == Press::short_press && !sample.valid)
          context_.announcements.refuse("The device is not homed yet.");
        // Without an inkwell, a press confirms the home position.
        if (!is_home || (!context_.plan.has_inkwell && press != Press::short_press)) {
          since_s_ = sample.t_s;
          return {};
        }
        if (context_.plan.has_inkwell && sample.t_s - since_s_ < kDocked_s) return {};
        since_s_ = sample.t_s;
        phase_ = Phase::settling;
        context_.announcements.praise("Home.");
        return {};
      }
      case Phase::settling:
        if (!sample.valid && passed_s > kDoubted_s) {
          begin();
          return {};
        }
        if (sample.valid) {
          settled_s_ += passed_s;
          since_s_ = sample.t_s;
        }
        if (settled_s_ < context_.plan.settle_s && context_.plan.procedure == CalibrationProcedure::full) return {};
        phase_ = Phase::take_out;
        if (sample.docked) context_.announcements.sounds.push_back(WizardSound::next);
        return {};
      case Phase::take_out:
        return sample.docked ? StepResult{} : StepResult::next();
    }
    return {};
  }

  void lost() override { begin(); }
  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override {
    view.title = "Bring the device home";
    view.button = {"", "leave", ""};
    view.inkwell = context_.plan.has_inkwell && phase_ != Phase::take_out;
    switch (phase_) {
      case Phase::to_inkwell:
        if (context_.plan.has_inkwell) {
          view.sentence = "Push the stylus into its inkwell and release it.";
        } else {
          view.sentence = "Move the stylus to the home position given by its maker, then press.";
          view.button.short_press = "it is home";
        }
        break;
      case Phase::settling:
        view.sentence =
            context_.plan.record.rig.mirror
                ? "Do not touch it: arm and motors settle. Switch the lamp under the mirror on and sit as for "
                  "work."
                : "Do not touch it: arm and motors settle. Sit as for work.";
        view.time_left_s = std::max(0.0, context_.plan.settle_s - settled_s_);
        view.progress = std::min(1.0, settled_s_ / std::max(1e-9, context_.plan.settle_s));
        break;
      case Phase::take_out:
        view.sentence = "Take the stylus out.";
        break;
    }
  }

 private:
  enum class Phase { to_inkwell, settling, take_out } phase_ = Phase::to_inkwell;
  double since_s_ = 0.0, settled_s_ = 0.0;
  bool seen_ = false;
};

}  // namespace

std::unique_ptr<WizardStep> homeStep(WizardContext& context) { return std::make_unique<HomeStep>(context); }

}  // namespace app
