// The technician's procedure, page by page: identity, homing, flips, pixel size, eyes, touches, fit, verification,
// sign-off; and the short procedures. Input: stylus samples tick by tick; output: the view and sounds. No window,
// clock, file or device; forces are off. The same ticks give the same outcome. Frame W, mm, s. One thread; a tick takes
// a few microseconds, the fit up to a second; takeView() a few more.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "app/calibrate/steps/step.h"

namespace app {

class Wizard {
 public:
  /// Throws CalibrationError: no such method, no such model of device.
  explicit Wizard(WizardPlan plan);

  /// In the order of time. Every tick of 500 to 10,000 Hz, also invalid ones.
  void update(const StylusSample& sample);
  /// With the sounds since the last takeView.
  WizardView takeView();

  bool isOver() const { return context_.outcome.end != WizardOutcome::End::running; }
  const WizardOutcome& outcome() const { return context_.outcome; }
  const WizardPlan& plan() const { return context_.plan; }

 private:
  WizardStep& step() const { return *steps_[at_].second; }
  void turnTo(std::size_t page);
  void apply(const StepResult& answer);

  WizardContext context_;
  using Page = std::pair<StepName, std::unique_ptr<WizardStep>>;
  std::vector<Page> steps_;
  std::size_t at_ = 0;
  std::string said_before_;  ///< the message with which this page began
  ButtonPress button_;
  bool lost_ = false;
  std::optional<double> valid_s_;  ///< time of the last valid sample
};

}  // namespace app
