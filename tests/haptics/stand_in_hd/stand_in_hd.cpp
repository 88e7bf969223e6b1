// The functions of HDAPI as reference/devices 2 gives them, before the machine of the stand-in.
#include "tests/haptics/stand_in_hd/stand_in_hd.h"

#include <cmath>
#include <limits>

#include "tests/haptics/stand_in_hd/stand_in_machine.h"

namespace {

using stand_in::Machine;
namespace hd = haptics::hd;

Machine& machine() { return Machine::only(); }

/// Before the first device there is nothing to check.
bool isOfFrame(hd::Enum property) { return property >= 0x2000 && property < 0x2500; }

void copyOut(const std::array<std::atomic<double>, 3>& from, double* to) {
  for (std::size_t i = 0; i < 3; ++i) to[i] = from[i];
}

void transformOut(double* to) {
  const auto& door = machine().door();
  for (std::size_t i = 0; i < 16; ++i) to[i] = door.script.turn[i];
  for (std::size_t i = 0; i < 3; ++i) to[12 + i] = door.seen.position_mm[i];
}

}  // namespace

extern "C" {

stand_in::StandIn* standIn() {
  stand_in::StandIn& door = machine().door();
  door.reset = [] { machine().reset(); };
  door.open_devices = [] { return machine().openDevices(); };
  return &door;
}

hd::DeviceId hdInitDevice(const char* name) { return machine().init(name); }
void hdDisableDevice(hd::DeviceId id) { machine().disableDevice(id); }
void hdMakeCurrentDevice(hd::DeviceId) { machine().enter("hdMakeCurrentDevice"); }
void hdBeginFrame(hd::DeviceId id) { machine().beginFrame(id); }
void hdEndFrame(hd::DeviceId id) { machine().endFrame(id); }
void hdEnable(hd::Enum what) { machine().switchMotors(what, true); }
void hdDisable(hd::Enum what) { machine().switchMotors(what, false); }
hd::ErrorInfo hdGetError() { return machine().takeError(); }
hd::Enum hdCheckCalibration() { return machine().calibration(); }
void hdUpdateCalibration(hd::Enum style) { machine().updateCalibration(style); }
void hdSetSchedulerRate(unsigned long rate_Hz) { machine().setRate(rate_Hz); }
void hdStartScheduler() { machine().startScheduler(); }
void hdStopScheduler() { machine().stopScheduler(); }
void hdUnschedule(hd::ScheduleId id) { machine().unschedule(id); }
hd::ScheduleId hdScheduleAsynchronous(hd::Callback callback, void* data, unsigned short priority) {
  return machine().schedule(callback, data, priority);
}

void hdGetBooleanv(hd::Enum property, hd::Boolean* value) {
  machine().enter("hdGetBooleanv", isOfFrame(property));
  if (machine().isUnknown(property)) return;
  const auto& script = machine().door().script;
  if (property == hd::kCurrentInkwellSwitch)
    *value = script.docked == script.docked_value;
  else if (property == hd::kCurrentSafetySwitch)
    *value = script.held;
  else
    machine().raise(0x0100);
}

void hdGetIntegerv(hd::Enum property, int* value) {
  machine().enter("hdGetIntegerv", isOfFrame(property));
  if (machine().isUnknown(property)) return;
  const auto& script = machine().door().script;
  if (property == hd::kCurrentButtons)
    *value = script.buttons;
  else if (property == hd::kInputDof)
    *value = script.input_dof;
  else if (property == hd::kOutputDof)
    *value = 3;
  else if (property == hd::kCalibrationStyle)
    *value = script.calibration_style;
  else if (property == hd::kUpdateRate || property == hd::kInstantaneousUpdateRate)
    *value = script.update_rate_Hz;
  else
    machine().raise(0x0100);
}

void hdGetDoublev(hd::Enum property, double* value) {
  machine().enter("hdGetDoublev", isOfFrame(property));
  if (machine().isUnknown(property)) return;
  const auto& door = machine().door();
  constexpr double kWorkspace_mm[] = {-160.0, -70.0, -58.0, 160.0, 200.0, 90.0};
  switch (property) {
    case hd::kCurrentPosition:
      copyOut(door.seen.position_mm, value);
      if (door.script.garbage) value[1] = std::numeric_limits<double>::quiet_NaN();
      break;
    case hd::kCurrentVelocity:
      for (int i = 0; i < 3; ++i) value[i] = machine().velocity(i);
      break;
    case hd::kCurrentTransform:
      transformOut(value);
      break;
    case hd::kCurrentJointAngles:
      copyOut(door.script.joints_rad, value);
      break;
    case hd::kCurrentGimbalAngles:
      copyOut(door.script.gimbal_rad, value);
      break;
    case hd::kMotorTemperature:
      for (int i = 0; i < 3; ++i) value[i] = i == 1 ? door.script.heat.load() : 0.0;
      break;
    case hd::kNominalMaxForce:
      *value = door.script.max_force_N;
      break;
    case hd::kNominalMaxContinuousForce:
      *value = 0.88;
      break;
    case hd::kNominalMaxStiffness:
      *value = 0.5;
      break;
    case hd::kNominalMaxDamping:
      *value = 0.003;
      break;
    case hd::kUsableWorkspace:
      for (int i = 0; i < 6; ++i) value[i] = kWorkspace_mm[i];
      break;
    default:
      machine().raise(0x0100);
  }
}

void hdSetDoublev(hd::Enum property, const double* value) {
  if (property == hd::kCurrentForce) return machine().setForce(value);
  machine().raise(0x0100);
}

const char* hdGetString(hd::Enum property) {
  machine().enter("hdGetString");
  switch (property) {
    case hd::kModel:
      return machine().door().script.model;
    case hd::kVersion:
      return "3.5.0";
    case hd::kDriverVersion:
      return "2022.4.4";
    case hd::kSerialNumber:
      return "50127600138";
    default:
      machine().raise(0x0100);
      return nullptr;
  }
}

}  // extern "C"
