// Four crosses in stereo, before and behind the screen's plane: their apparent position shows whether pupils and
// distance were measured well. The eyes are not fitted to them: so few alignments leave 20 mm open. One thread. Source:
// reference/calibration 2.2.

#include <cmath>

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/number_text.h"
#include "app/calibrate/steps/touch_step.h"

namespace app {
namespace {

constexpr double kMostBias_mm = 1.0, kMostDepthBias_mm = 2.0;

/// Where they are, and how the stylus is held there.
calibration::TargetPlan eyeCheckPlan() {
  calibration::TargetPlan plan{"eyes4", calibration::TargetKind::cross, calibration::kCrossPrecision, {}};
  const calibration::Vector<calibration::World> rest = calibration::kRestingStylus_W;
  plan.targets = {{1, {{-35.0, 20.0, 25.0}}, rest},
                  {2, {{35.0, 20.0, -25.0}}, rest},
                  {3, {{35.0, -20.0, 25.0}}, rest},
                  {4, {{-35.0, -20.0, -25.0}}, rest}};
  return plan;
}

class EyeCheckStep final : public TouchStep {
 public:
  using TouchStep::TouchStep;
  void begin() override {
    const calibration::TargetPlan plan = eyeCheckPlan();
    context_.outcome.eye_check = emptySet(context_, plan);
    startRound(plan, 0.0);
    round_->ignoreTilt();
    doubt_.reset();
  }

  StepResult update(const StylusSample& sample, Press press, double pressed_s) override {
    if (doubt_) {
      const auto chosen = doubt_->update(press);
      if (!chosen) return {};
      return *chosen == 0 ? StepResult::goTo(StepName::eyes) : StepResult::next();
    }
    return TouchStep::update(sample, press, pressed_s);
  }

  void show(WizardView& view) const override {
    view.title = "Crosses in depth";
    view.sentence = "Both eyes open, head in its rest: tip to the glowing cross where it floats.";
    round_->show(view);
    view.zero_parallax = false;
    if (!doubt_) return;
    view.sentence = finding_;
    doubt_->show(view);
  }

 private:
  StepResult completed() override {
    context_.outcome.eye_check.touches = round_->touches();

    // Nearer before the plane and further behind it: pupils or distance; all to one side: the head's place.
    glm::dvec3 bias_mm(0.0);
    double stretch_mm = 0.0;
    for (const calibration::Residual& seen :
         calibration::residualsOf(context_.arm, context_.outcome.eye_check.touches)) {
      bias_mm += 0.25 * seen.error_mm.xyz;
      stretch_mm += 0.25 * seen.error_mm.xyz.z * (seen.target_W.mm.z > 0.0 ? 1.0 : -1.0);
    }
    const double across_mm = std::hypot(bias_mm.x, bias_mm.y);
    if (across_mm <= kMostBias_mm && std::abs(bias_mm.z) <= kMostDepthBias_mm &&
        std::abs(stretch_mm) <= kMostDepthBias_mm)
      return StepResult::next();
    finding_ = std::abs(stretch_mm) > kMostDepthBias_mm ? "Depth is seen " + mmText(std::abs(stretch_mm)) +
                                                              (stretch_mm > 0.0 ? " too large" : " too small") +
                                                              " at 25 mm: measure pupils and distance again."
                                                        : "The crosses appear " + mmText(glm::length(bias_mm)) +
                                                              " off: sit as for work and measure the eyes again.";
    doubt_ = ChoiceMenu({"measure the eyes again", "go on as it is"});
    context_.announcements.refuse(finding_);
    return {};
  }

  std::optional<ChoiceMenu> doubt_;
  std::string finding_;
};

}  // namespace

std::unique_ptr<WizardStep> eyeCheckStep(WizardContext& context) { return std::make_unique<EyeCheckStep>(context); }

}  // namespace app
