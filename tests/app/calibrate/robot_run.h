// A whole calibration by the robot technician: ticks at a rate, a takeView thirty times a second, until it is over or
// the patience ends.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "app/calibrate/robot_technician.h"
#include "app/calibrate/wizard.h"

namespace app {

struct RobotRun {
  std::vector<std::string> titles;  ///< as they came, each once in a row
  std::set<std::string> messages;
  std::vector<WizardView> pages;  ///< the first view of each title
  int sounds[4] = {0, 0, 0, 0};
  double seconds = 0.0;

  void note(const WizardView& view) {
    if (titles.empty() || titles.back() != view.title) {
      titles.push_back(view.title);
      pages.push_back(view);
    }
    if (!view.message.text.empty()) messages.insert(view.message.text);
    for (const WizardSound sound : view.sounds) ++sounds[static_cast<int>(sound)];
  }
  bool said(const std::string& words) const {
    for (const std::string& message : messages)
      if (message.find(words) != std::string::npos) return true;
    return false;
  }
  bool turnedTo(const std::string& title) const {
    for (const std::string& seen : titles)
      if (seen == title) return true;
    return false;
  }
};

/// What happens to a tick between device and wizard.
using Mishap = std::function<void(StylusSample&, const WizardView&)>;

inline RobotRun runWizard(Wizard& wizard, RobotTechnician& technician, double rate_Hz = 500.0,
                          const Mishap& mishap = {}, double most_s = 1200.0) {
  RobotRun run;
  WizardView view = wizard.takeView();
  const int every = static_cast<int>(rate_Hz / 30.0);
  for (int i = 0; i < static_cast<int>(most_s * rate_Hz) && !wizard.isOver(); ++i) {
    StylusSample sample = technician.next(view, i / rate_Hz);
    if (mishap) mishap(sample, view);
    wizard.update(sample);
    run.seconds = i / rate_Hz;
    if (i % every != 0) continue;
    view = wizard.takeView();
    run.note(view);
  }
  run.note(wizard.takeView());
  return run;
}

inline WizardPlan planFor(const calibration::SyntheticRig& rig, CalibrationProcedure procedure,
                          const std::string& method = "jig27") {
  WizardPlan plan;
  plan.procedure = procedure;
  plan.method = method;
  plan.record.rig = rig.nominal;
  plan.record.provenance.rig_id = "rig-02";
  plan.device = *rig.nominal.device;
  return plan;
}

/// Root mean square of the tip's error anywhere within ±30 mm, held in any way.
inline double trueError_mm(const calibration::SyntheticRig& rig, const calibration::MeasuredArm& arm) {
  std::mt19937 rng(4711);
  double sum_mm2 = 0.0;
  const auto touches = calibration::heldOutTouches(rig, 200, glm::dvec3(30.0), rng);
  for (const calibration::Touch& touch : touches) {
    const glm::dvec3 off_mm = arm.tip_W(touch.joints_rad).mm - touch.target_W.mm;
    sum_mm2 += glm::dot(off_mm, off_mm) / static_cast<double>(touches.size());
  }
  return std::sqrt(sum_mm2);
}

}  // namespace app
