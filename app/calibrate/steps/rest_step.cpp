// Position of the hand rest: three touches of its marks give its pose, three more verify it. One thread.

#include <algorithm>

#include "app/calibrate/steps/touch_step.h"

namespace app {
namespace {

constexpr std::size_t kMarks = 3;
constexpr double kMaxRestShift_mm = 60.0;  // an unregistered rest may be anywhere near its place

class RestStep final : public TouchStep {
 public:
  using TouchStep::TouchStep;
  void begin() override {
    fitted_.clear();
    context_.outcome.rest.reset();
    touchMarks("rest3", context_.plan.record.rest.value_or(calibration::RestRegistration{}), 0);
  }

  StepResult update(const StylusSample& sample, Press press, double pressed_s) override {
    if (context_.plan.rest_marks_mm.size() != 2 * kMarks)
      return StepResult::refused("The hand rest needs six known marks: name them in the rig's settings.");
    return TouchStep::update(sample, press, pressed_s);
  }

  void show(WizardView& view) const override {
    view.title = fitted_.empty() ? "Position of the hand rest" : "Verify the hand rest";
    view.sentence = "Touch the glowing mark on the rest; any tilt will do.";
    round_->show(view);
  }

 private:
  StepResult completed() override {
    const bool verified = !fitted_.empty();
    context_.outcome.rest =
        calibration::registerRest(verified ? fitted_ : touched(), verified ? touched() : MarkTouches{});
    if (verified) return StepResult::next();
    fitted_ = touched();
    touchMarks("rest3proof", *context_.outcome.rest, kMarks);
    return {};
  }

  /// Touches kMarks marks from `first` on, of a rest in this pose.
  void touchMarks(const char* method, const calibration::RestRegistration& rest, std::size_t first) {
    calibration::TargetPlan plan{method, calibration::TargetKind::pit, calibration::kPitPrecision, {}};
    for (std::size_t i = first; i < std::min(first + kMarks, context_.plan.rest_marks_mm.size()); ++i)
      plan.targets.push_back(
          {static_cast<int>(i) + 1, rest.position_W(context_.plan.rest_marks_mm[i]), calibration::kRestingStylus_W});
    startRound(std::move(plan), kMaxRestShift_mm);
    round_->ignoreTilt();
  }

  using MarkTouches = std::vector<calibration::MarkTouch>;
  MarkTouches touched() const {
    MarkTouches marks;
    for (const calibration::Touch& touch : round_->touches())
      marks.push_back(
          {context_.plan.rest_marks_mm[static_cast<std::size_t>(touch.id - 1)], context_.arm.tip_W(touch.joints_rad)});
    return marks;
  }

  MarkTouches fitted_;  ///< empty: being touched
};

}  // namespace

std::unique_ptr<WizardStep> restStep(WizardContext& context) { return std::make_unique<RestStep>(context); }

}  // namespace app
