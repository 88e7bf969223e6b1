#include "app/calibrate/base_rig.h"

#include "calibration/arm/phantom_models.h"
#include "calibration/record/rig_file.h"
#include "calibration/record/rig_store.h"
#include "calibration/rig.h"

namespace app {

using namespace calibration;

RigRecord baseRig(const std::string& named) {
  const auto default_rig = defaultRig(named);
  if (!default_rig) return readRigRecord(named);
  RigRecord record;
  record.rig = *default_rig;
  return record;
}

MeasuredArm armOf(const RigRecord& record, const TouchSet& touches, const std::string& named) {
  const PhantomModel* const model = findPhantomModel(touches.device_model);
  if (model == nullptr)
    throw CalibrationError("observations: device '" + touches.device_model + "' is not known, give omni, touch, " +
                           "desktop or premium");
  if (record.rig.device) {
    const std::string why = whyNotFor(record, touches.device_model, touches.serial, touches.mount);
    if (!why.empty()) throw CalibrationError("rig file " + named + ": " + why);
  }
  return {model->geometry, record.rig.arm.value_or(ArmCorrection{}), record.rig.X_WD};
}

}  // namespace app
