// Where the hand rest stands: three touches of its marks make its pose, three more prove it. One thread.

#include "app/calibrate/number_words.h"
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
    plan.targets.push_back({static_cast<int>(i) + 1, rest.place_W(marks_mm[i]), calibration::kRestingStylus_W});
  return plan;
}

class RestStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override {
    made_of_.clear();
    book_.outcome.rest.reset();
    const auto believed = book_.plan.record.rest.value_or(calibration::RestRegistration{});
    round_.emplace(marksPlan("rest3", believed, book_.plan.rest_marks_mm, 0), book_.arm, kFarRest_mm, book_.voice);
    round_->letTiltBe();
  }

  StepAnswer feel(const StylusSample& sample, Press press, double pressed_s) override {
    if (book_.plan.rest_marks_mm.size() != 2 * kMarks)
      return StepAnswer::refused("The hand rest has no six known marks: name them in the rig's settings.");
    if (round_->feel(sample, press, pressed_s) == TouchRound::Happened::left) return StepAnswer::declined();
    if (!round_->isComplete()) return {};

    try {
      if (made_of_.empty()) {
        book_.outcome.rest = calibration::restRegistered(touched(), {});
        made_of_ = touched();
        beginProof();
        return {};
      }
      book_.outcome.rest = calibration::restRegistered(made_of_, touched());
      return StepAnswer::next();
    } catch (const calibration::CalibrationError& error) {
      begin();
      book_.voice.refuse(error.what());
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
          {book_.plan.rest_marks_mm[static_cast<std::size_t>(touch.id - 1)], book_.arm.tip_W(touch.joints_rad)});
    return marks;
  }

  void beginProof() {
    round_.emplace(marksPlan("rest3proof", *book_.outcome.rest, book_.plan.rest_marks_mm, kMarks), book_.arm,
                   kFarRest_mm, book_.voice);
    round_->letTiltBe();
  }

  std::optional<TouchRound> round_;
  std::vector<calibration::MarkTouch> made_of_;  ///< empty: they are being touched
};

}  // namespace

std::unique_ptr<WizardStep> restStep(WizardBook& book) { return std::make_unique<RestStep>(book); }

}  // namespace app
