// The last page: the result, details on a second page, and acceptance; a red result cannot be accepted. One thread.

#include <cctype>

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/number_text.h"
#include "app/calibrate/steps/step.h"

namespace app {
namespace {

const char* verdictText(calibration::Verdict verdict) {
  if (verdict == calibration::Verdict::green) return "Good";
  return verdict == calibration::Verdict::amber ? "Usable, not good" : "Not good enough";
}

class SignOffStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override {
    second_page_ = false;
    choices_.clear();
    std::vector<std::string> words;
    const auto add = [&](Choice choice, const char* text) {
      choices_.push_back(choice);
      words.emplace_back(text);
    };
    const bool may = verdict() != calibration::Verdict::red;
    const bool changes = context_.outcome.arm || context_.outcome.rest;
    if (may) add(Choice::take, changes ? "take it" : "done");
    add(Choice::numbers, "details");
    // Red after a re-zero needs a full calibration; another short check does not help.
    if (context_.plan.procedure == CalibrationProcedure::full || context_.plan.procedure == CalibrationProcedure::rest)
      add(Choice::repeat, "touch all again");
    if (changes || !may) add(Choice::leave, "leave; the old calibration stays");
    menu_ = ChoiceMenu(words);
    context_.announcements.sounds.push_back(may ? WizardSound::done : WizardSound::reject);
  }

  StepResult update(const StylusSample&, Press press, double) override {
    // The second page has no room for choices: any press turns back.
    if (second_page_) {
      second_page_ = press != Press::short_press && press != Press::long_press;
      return {};
    }
    const auto chosen = menu_.update(press);
    if (!chosen) return {};
    switch (choices_[*chosen]) {
      case Choice::take:
        return StepResult::accepted(sentence());
      case Choice::numbers:
        second_page_ = true;
        return {};
      case Choice::repeat:
        return StepResult::goTo(context_.plan.procedure == CalibrationProcedure::rest ? StepName::rest
                                                                                      : StepName::collect);
      case Choice::leave:
        return verdict() == calibration::Verdict::red ? StepResult::refused(sentence()) : StepResult::declined();
    }
    return {};
  }

  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override {
    view.verdict = ShownVerdict{verdict(), sentence()};
    if (second_page_) {
      view.title = "Details";
      view.sentence = sentence();
      view.numbers = numbers();
      view.button = {"back", "back", ""};
      return;
    }
    view.title = verdictText(verdict());
    view.sentence =
        verdict() == calibration::Verdict::red ? "It cannot be accepted." : "Accept it, or keep the old calibration.";
    menu_.show(view);
  }

 private:
  enum class Choice { take, numbers, repeat, leave };
  calibration::Verdict verdict() const {
    if (context_.plan.procedure != CalibrationProcedure::rest)
      return context_.outcome.assessment ? context_.outcome.assessment->verdict : calibration::Verdict::red;
    const auto& rest = context_.outcome.rest;
    if (!rest) return calibration::Verdict::red;
    return rest->worst_mm > calibration::kMaxRestError_mm ? calibration::Verdict::amber : calibration::Verdict::green;
  }

  std::string sentence() const {
    std::string said = verdictText(verdict());
    if (context_.plan.procedure == CalibrationProcedure::rest && context_.outcome.rest)
      return said + ": the position of the rest is known within " + mmText(context_.outcome.rest->worst_mm) +
             (verdict() == calibration::Verdict::green ? "." : ", which is noticeable: touch its marks again.");
    if (!context_.outcome.assessment) return said + ".";
    // As the surgeon sees it; what decided it where it is not good.
    std::string worst = calibration::worstErrorSentence(context_.outcome.verification_residuals, {});
    worst[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(worst[0])));
    said += ". " + worst;
    if (verdict() != calibration::Verdict::green) said += " (" + context_.outcome.assessment->reason + ")";
    if (verdict() == calibration::Verdict::red)
      said += context_.plan.procedure == CalibrationProcedure::full
                  ? "; the old calibration stays"
                  : "; calibrate it in full, and have arm and base looked at";
    return said + ".";
  }

  std::vector<ShownValue> numbers() const {
    std::vector<ShownValue> numbers;
    const WizardOutcome& outcome = context_.outcome;
    if (outcome.rest)
      numbers = {{"rest, residual of its marks", mmText(outcome.rest->fre_rms_mm)},
                 {"rest, largest error of three other marks", mmText(outcome.rest->worst_mm)}};
    if (const auto& errors = outcome.errors) {
      numbers.push_back({"held-out touches", std::to_string(errors->n)});
      numbers.push_back({"error, root mean square", mmText(errors->rms_mm)});
      numbers.push_back({"error, 95 of 100", mmText(errors->p95_mm)});
      numbers.push_back({"error, largest", mmText(errors->max_mm)});
      numbers.push_back({"mean error: right, up, near", signedText(errors->bias_mm.xyz.x, 2) + ", " +
                                                            signedText(errors->bias_mm.xyz.y, 2) + ", " +
                                                            signedText(errors->bias_mm.xyz.z, 2) + " mm"});
    }
    if (const auto& fit = outcome.fit) {
      numbers.push_back({"touches used, set aside", std::to_string(fit->used) + ", " + std::to_string(fit->outliers)});
      numbers.push_back({"cross-validation error", mmText(fit->cv_rms_mm)});
      numbers.push_back({"range of stylus tilts", fixedText(fit->tilt_spread_deg, 0) + "°"});
    }
    if (const auto& rezero = outcome.rezero)
      numbers.push_back(
          {"base moved, turned", mmText(rezero->moved_mm) + ", " + fixedText(rezero->turned_deg, 2) + "°"});
    if (const auto& verification = context_.plan.record.verification)
      numbers.push_back({"error before", mmText(verification->errors.rms_mm)});
    if (outcome.duration_s > 0.0) numbers.push_back({"time for the touches", fixedText(outcome.duration_s, 0) + " s"});
    return numbers;
  }

  std::vector<Choice> choices_;
  ChoiceMenu menu_{{}};
  bool second_page_ = false;
};

}  // namespace

std::unique_ptr<WizardStep> signOffStep(WizardContext& context) { return std::make_unique<SignOffStep>(context); }

}  // namespace app
