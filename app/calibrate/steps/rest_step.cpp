// Where the hand rest stands: three touches of its marks make its pose, three more prove it. One thread.

#include "app/calibrate/number_text.h"
#include "app/calibrate/steps/step.h"
#include "app/calibrate/touch_round.h"

namespace app {
namespace {

constexpr std::size_t kMarks = 3;
constexpr double kFarRest_mm = 60.0;  // a rest that was never registered stands where it was put

/// Marks of a rest in this pose; the stylus as it comes.
calibration::TargetPlan marksPlan(const char* method, const calibration::RestRegistration& rest,
                                  const std::vector<glm::dvec3>& marks_mm, std::size_t first) {
  calibration::TargetPlan plan{method, calibration::TargetKind::pit, calibration::kPitPrecision, {}};
  for (std::size_t i = first; i < first + kMarks; ++i)
    plan.targets.push_back({static_cast<int>(i) + 1, rest.position_W(marks_mm[i]), calibration::kRestingStylus_W});
  return plan;
}

class RestStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override {
    made_of_.clear();
    context_.outcome.rest.reset();
    const auto believed = context_.plan.record.rest.value_or(calibration::RestRegistration{});
    round_.emplace(marksPlan("rest3", believed, context_.plan.rest_marks_mm, 0), context_.arm, kFarRest_mm,
                   context_.announcements);
    round_->ignoreTilt();
  }

  StepResult update(const StylusSample& sample, Press press, double pressed_s) override {
    if (context_.plan.rest_marks_mm.size() != 2 * kMarks)
      return StepResult::refused("The hand rest has no six known marks: name them in the rig's settings.");
    if (round_->update(sample, press, pressed_s) == TouchRound::TouchEvent::left) return StepResult::declined();
    if (!round_->isComplete()) return {};

    try {
      if (made_of_.empty()) {
        context_.outcome.rest = calibration::registerRest(touched(), {});
        made_of_ = touched();
        beginProof();
        return {};
      }
      context_.outcome.rest = calibration::registerRest(made_of_, touched());
      return StepResult::next();
    } catch (const calibration::CalibrationError& error) {
      begin();
      context_.announcements.refuse(error.what());
      return {};
    }
  }

  void lost() override { round_->lost(); }
  void show(WizardView& view) const override {
    view.title = made_of_.empty() ? "Where the hand rests" : "Prove the hand rest";
    view.sentence = "Touch the glowing mark on the rest; hold the stylus as it comes.";
    round_->show(view);
  }

 private:
  std::vector<calibration::MarkTouch> touched() const {
    std::vector<calibration::MarkTouch> marks;
    for (const calibration::Touch& touch : round_->touches())
      marks.push_back(
          {context_.plan.rest_marks_mm[static_cast<std::size_t>(touch.id - 1)], context_.arm.tip_W(touch.joints_rad)});
    return marks;
  }

  void beginProof() {
    round_.emplace(marksPlan("rest3proof", *context_.outcome.rest, context_.plan.rest_marks_mm, kMarks), context_.arm,
                   kFarRest_mm, context_.announcements);
    round_->ignoreTilt();
  }

  std::optional<TouchRound> round_;
  std::vector<calibration::MarkTouch> made_of_;  ///< empty: they are being touched
};

}  // namespace

std::unique_ptr<WizardStep> restStep(WizardContext& context) { return std::make_unique<RestStep>(context); }

}  // namespace app
