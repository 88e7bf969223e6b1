// The touches of the calibration, checked as they arrive: after eight, each is compared with where the others
// predict it. At the end the worst can be repeated; a single tilt for all touches is refused. One thread.

#include "app/calibrate/number_text.h"
#include "app/calibrate/steps/step.h"
#include "app/calibrate/touch_round.h"
#include "calibration/fit/fit_warnings.h"
#include "calibration/fit/quick_fit.h"

namespace app {
namespace {

constexpr std::size_t kLeastJudged = 8;
constexpr int kMostOneWay = 1;                 ///< requests to follow the cue
constexpr double kMaxMedianResidual_mm = 3.0;  ///< left at the touches: beyond, they belong to other targets

class CollectStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override {
    const calibration::TargetPlan plan = *calibration::targetPlan(context_.plan.method, context_.plan.jig);
    round_.emplace(plan, context_.arm, 0.0, context_.announcements);
    context_.outcome.touches = emptySet(context_, plan);
    end_.reset();
    held_one_way_ = 0;
  }

  StepResult update(const StylusSample& sample, Press press, double pressed_s) override {
    // At the end the button answers, and the stylus is free.
    if (end_) {
      if (const auto chosen = end_->update(press)) return answered(*chosen);
      return {};
    }
    switch (round_->update(sample, press, pressed_s)) {
      case TouchRound::TouchEvent::left:
        return StepResult::declined();
      case TouchRound::TouchEvent::started_again:
        round_->setArm(context_.arm, 0.0);
        break;
      case TouchRound::TouchEvent::taken:
      case TouchRound::TouchEvent::undone:
        judgeSoFar();
        if (round_->isComplete()) askAtTheEnd();
        break;
      case TouchRound::TouchEvent::nothing:
        break;
    }
    return {};
  }

  void lost() override { round_->lost(); }
  void show(WizardView& view) const override {
    view.title = context_.byEyes() ? "Touch the crosses" : "Touch the pits";
    view.sentence =
        context_.byEyes()
            ? "Tip to the glowing cross, one eye closed: sway the head, tip and cross must not slide. Hold it "
              "as the cue shows."
            : "Put the tip into the glowing pit, tilted as shown.";
    round_->show(view);
    if (!end_) return;
    view.tilt.reset();
    view.title = little_tilt_ ? "Always the same tilt" : "All targets touched";
    view.sentence = little_tilt_ ? "The directions of the stylus are only " + fixedText(round_->tiltSpread_deg(), 0) +
                                       "° apart: 25° are needed."
                                 : "Go on, or repeat the worst touch.";
    end_->show(view);
  }

 private:
  void judgeSoFar() {
    const calibration::TouchSet set = touches();
    worst_.reset();
    if (set.touches.size() < kLeastJudged) return round_->setArm(context_.arm, 0.0);
    const calibration::QuickFit quick = calibration::quickFit(context_.arm, set);
    std::vector<bool> doubtful = quick.doubtful;

    // Beyond repair by one touch: the fit would say so, too, but later.
    std::size_t many = 0;
    for (const bool is : doubtful) many += is ? 1 : 0;
    const bool mixed_up = 3 * many > doubtful.size() || quick.median_mm > kMaxMedianResidual_mm;
    if (mixed_up) {
      round_->setArm(context_.arm, 0.0);
      context_.announcements.refuse("The touches do not fit together: touch them in the order they glow.");
    } else {
      round_->setArm(quick.arm, context_.byEyes() ? 6.0 : 5.0);
    }
    round_->setDoubtful(doubtful);
    worst_mm_ = 0.0;
    for (std::size_t i = 0; i < quick.left_out_mm.size(); ++i)
      if (const double off_mm = glm::length(quick.left_out_mm[i].xyz); off_mm > worst_mm_) {
        worst_mm_ = off_mm;
        worst_ = i;
      }
  }

  void askAtTheEnd() {
    little_tilt_ = round_->tiltSpread_deg() < calibration::kMinTilt_deg;
    held_one_way_ += little_tilt_ ? 1 : 0;
    if (little_tilt_) {
      end_ = ChoiceMenu({"touch those again that were held wrongly", "leave; the old calibration stays"});
      return;
    }
    const bool doubtful = worst_ && round_->isDoubtful(*worst_);
    const std::string redo =
        worst_ ? "touch the worst again: " + round_->nameOf(*worst_) + ", " + mmText(worst_mm_) + " off"
               : "start again";
    end_ = ChoiceMenu({"go on with these touches", redo, "leave; the old calibration stays"}, doubtful ? 1 : 0);
  }

  StepResult answered(std::size_t choice) {
    end_.reset();
    if (little_tilt_) {
      if (choice == 1 || held_one_way_ > kMostOneWay)
        return StepResult::refused(
            "The stylus was held one way all the time: what its gimbal gets wrong would stay hidden. "
            "Calibrate again and follow the cue.");
      std::vector<std::size_t> wrong = round_->wronglyTilted();
      // From the last, so that their numbers hold.
      while (!wrong.empty()) {
        round_->again(wrong.back());
        wrong.pop_back();
      }
      if (round_->isComplete()) round_->retakeAll();
      return {};
    }
    if (choice == 2) return StepResult::declined();
    if (choice == 1) {
      if (worst_)
        round_->again(*worst_);
      else
        round_->retakeAll();
      return {};
    }
    context_.outcome.touches = touches();
    context_.outcome.duration_s = round_->duration_s();
    return StepResult::next();
  }

  calibration::TouchSet touches() const {
    calibration::TouchSet set = context_.outcome.touches;
    set.touches = round_->touches();
    return set;
  }

  std::optional<TouchRound> round_;
  std::optional<ChoiceMenu> end_;
  std::optional<std::size_t> worst_;
  double worst_mm_ = 0.0;
  bool little_tilt_ = false;
  int held_one_way_ = 0;  ///< times
};

}  // namespace

calibration::TouchSet emptySet(const WizardContext& context, const calibration::TargetPlan& plan) {
  calibration::TouchSet set;
  set.device_model = context.plan.device.model;
  set.serial = context.plan.device.serial;
  set.mount = context.plan.device.mount;
  set.method = plan.method;
  set.precision = plan.precision;
  return set;
}

std::unique_ptr<WizardStep> collectStep(WizardContext& context) { return std::make_unique<CollectStep>(context); }

}  // namespace app
