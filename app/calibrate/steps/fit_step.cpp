// Fits the arm to its touches and reports warnings of the fit. One thread; update() takes
// up to a second once.

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/number_text.h"
#include "app/calibrate/steps/step.h"

namespace app {
namespace {

constexpr double kShown_s = 0.1;     // the page is seen before it is worked
constexpr double kMuddled_mm = 4.0;  // cross-validated: no arm is as untrue as that

class FitStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override {
    worked_ = failed_ = false;
    since_s_.reset();
    context_.outcome.fit.reset();
    context_.outcome.arm.reset();
  }

  StepResult update(const StylusSample& sample, Press press, double) override {
    if (!since_s_) since_s_ = sample.t_s;
    if (!worked_) {
      if (sample.t_s - *since_s_ >= kShown_s) work();
      return {};
    }
    const auto chosen = menu_.update(press);
    if (!chosen) return {};
    if (!failed_ && *chosen == 0) return StepResult::next();
    if (*chosen == (failed_ ? 0U : 1U)) return StepResult::goTo(StepName::collect);
    if (failed_) return StepResult::refused(why_);
    return StepResult::declined();
  }

  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override {
    view.title = !worked_ ? "One moment" : failed_ ? "The fit failed" : "The arm is fitted";
    if (!worked_) {
      view.sentence = "The arm is being fitted to the touches.";
      return;
    }
    menu_.show(view);
    if (failed_) {
      view.sentence = why_;
      return;
    }
    const calibration::ArmFit& fit = *context_.outcome.fit;
    view.sentence = "Next, it is verified with touches that were not fitted.";
    view.facts = {std::to_string(fit.used) + " touches used, " + std::to_string(fit.outliers) + " set aside",
                  "expected error " + mmText(fit.cv_rms_mm)};
    for (const calibration::FitWarning& warning : fit.warnings) view.facts.push_back(warning.line);
  }

 private:
  void work() {
    worked_ = true;
    try {
      calibration::FitOptions options;
      options.region_mm3 = context_.plan.region_mm3;
      calibration::ArmFit fit = calibration::fitArm(context_.outcome.touches, options);
      for (const calibration::FitWarning& warning : fit.warnings) {
        if (warning.kind == calibration::FitWarning::Kind::mirrored) return refuse(warning.line);
        if (warning.kind == calibration::FitWarning::Kind::many_outliers && fit.outliers * 3 > fit.used)
          return refuse(warning.line);
      }
      if (fit.cv_rms_mm > kMuddled_mm && !context_.byEyes())
        return refuse("The touches do not fit together (" + mmText(fit.cv_rms_mm) +
                      "): touch the pits in the order they glow, and see that the block does not move.");
      context_.outcome.fit = std::move(fit);
      context_.outcome.arm = context_.outcome.fit->arm;
      context_.arm = context_.outcome.fit->arm;
      context_.arm_is_measured = true;
      menu_ = ChoiceMenu({"go on to the verification", "touch all again", "leave; the old calibration stays"});
      context_.announcements.praise("Fitted.", WizardSound::next);
    } catch (const calibration::CalibrationError& error) {
      refuse(error.what());
    }
  }

  void refuse(std::string why) {
    failed_ = true;
    why_ = std::move(why);
    menu_ = ChoiceMenu({"touch all again", "leave; the old calibration stays"});
    context_.announcements.refuse("No arm explains these touches.");
  }

  std::optional<double> since_s_;
  bool worked_ = false, failed_ = false;
  std::string why_;
  ChoiceMenu menu_{{}};
};

}  // namespace

std::unique_ptr<WizardStep> fitStep(WizardContext& context) { return std::make_unique<FitStep>(context); }

}  // namespace app
