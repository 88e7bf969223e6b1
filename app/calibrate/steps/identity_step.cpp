// Which rig, device, side and stylus tip: shown, and confirmed by who holds it. One thread.

#include "app/calibrate/choice_menu.h"
#include "app/calibrate/steps/step.h"
#include "calibration/record/rig_store.h"

namespace app {
namespace {

std::string orUnknown(const std::string& name) { return name.empty() ? "unknown" : name; }

/// Why a short procedure cannot build on what is there; empty: it can.
std::string whyNotBuiltOn(const calibration::Rig& rig, const calibration::RigDevice& device) {
  if (!rig.device || !rig.arm) return "This rig has never been calibrated with a device: calibrate it in full.";
  const auto differs = [](const char* what, const std::string& was, const std::string& is) {
    return std::string("The calibration was made with ") + what + " " + orUnknown(was) + ", here is " + orUnknown(is) +
           ": change it back, or calibrate in full.";
  };
  if (rig.device->model != device.model) return differs("the device", rig.device->model, device.model);
  if (rig.device->serial != device.serial) return differs("the serial number", rig.device->serial, device.serial);
  if (rig.device->mount != device.mount) return differs("the device at the side", rig.device->mount, device.mount);
  if (rig.device->stylus_tip != device.stylus_tip)
    return differs("the stylus tip", rig.device->stylus_tip, device.stylus_tip);
  return {};
}

class IdentityStep final : public WizardStep {
 public:
  using WizardStep::WizardStep;
  void begin() override { menu_ = ChoiceMenu({"all correct", "something is wrong"}); }

  StepResult update(const StylusSample&, Press press, double) override {
    if (context_.plan.procedure != CalibrationProcedure::full)
      if (std::string why = whyNotBuiltOn(context_.plan.record.rig, context_.plan.device); !why.empty())
        return StepResult::refused(std::move(why));
    const auto chosen = menu_.update(press);
    if (!chosen) return {};
    if (*chosen == 0) return StepResult::next();
    return StepResult::refused("Start again with the rig, device and stylus tip that are there.");
  }

  bool needsDevice() const override { return false; }
  void show(WizardView& view) const override {
    view.title = "Is this your equipment?";
    view.sentence = "Read the lines and compare them with rig, device and stylus. The forces are off.";
    const calibration::RigProvenance& known = context_.plan.record.provenance;
    const calibration::RigDevice& device = context_.plan.device;
    static const calibration::RigLocation kUnnamed;
    view.facts = {known.rig_id.empty() || known.rig_id == kUnnamed.rig_id ? "the only rig here, without a name"
                                                                          : "rig " + known.rig_id,
                  "device " + device.model + ", serial number " + orUnknown(device.serial),
                  "on the " + orUnknown(device.mount) + " of the surgeon", "stylus tip " + orUnknown(device.stylus_tip),
                  known.created_utc.empty() ? "never calibrated" : "calibrated " + known.created_utc};
    menu_.show(view);
  }

 private:
  ChoiceMenu menu_{{}};
};

}  // namespace

std::unique_ptr<WizardStep> identityStep(WizardContext& context) { return std::make_unique<IdentityStep>(context); }

}  // namespace app
