#include "haptics/device/openhaptics/hd_session.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "haptics/device/openhaptics/hd_error.h"
#include "haptics/device/openhaptics/hd_handle.h"

namespace haptics {
namespace {

constexpr double kMaxPlausibleForce_N = 50.0;   ///< more is an error
constexpr double kMaxStiffness_N_per_mm = 1.0;  ///< chai3d, Desktop; Omni 0.7, Touch 0.4
constexpr double kMaxDamping_Ns_per_mm = 0.005;
constexpr double kJointTorqueInUse_Nmm = 350.0;  ///< of an Omni, in practice (reference/devices 4.3)

std::string text(const HdFunctions& hd, hd::Enum property) {
  const char* value = hd.get_string(property);
  return value ? value : "";
}

/// The property, or `otherwise` if the library does not have it.
double number(const HdFunctions& hd, hd::Enum property, double otherwise) {
  std::array<double, kHdBufferSize> values{};
  hd.get_doublev(property, values.data());
  HdErrors errors;
  const bool known = errors.drain(hd).count == 0 && std::isfinite(values[0]) && values[0] > 0.0;
  return known ? values[0] : otherwise;
}

int integer(const HdFunctions& hd, hd::Enum property, int otherwise) {
  std::array<int, kHdBufferSize> values{};
  hd.get_integerv(property, values.data());
  HdErrors errors;
  return errors.drain(hd).count == 0 ? values[0] : otherwise;
}

bool readWorkspace(const HdFunctions& hd, hd::Enum property, WorkspaceBox& box) {
  std::array<double, kHdBufferSize> v{};
  hd.get_doublev(property, v.data());
  HdErrors errors;
  const glm::dvec3 least(v[0], v[1], v[2]), most(v[3], v[4], v[5]);
  const double diagonal = glm::length(most - least);
  if (errors.drain(hd).count > 0 || !std::isfinite(diagonal)) return false;
  if (!glm::all(glm::lessThan(least, most))) return false;
  box = {least, most};
  return true;
}

}  // namespace

HdSession::HdSession(const HdFunctions& hd, const std::string& configuration)
    : hd_(hd),
      name_("OpenHaptics, " + (configuration.empty() ? "default device" : "device \"" + configuration + "\"")),
      id_(hd.init_device(configuration.empty() ? nullptr : configuration.c_str())) {
  HdErrors errors;
  const HdDrained drained = errors.drain(hd);
  if (id_ != hd::kNoDevice && !drained.fatal) return;
  if (id_ != hd::kNoDevice) close();
  throw DeviceError(
      name_ + ", " +
          (drained.count > 0 ? errorText(drained.first)
                             : std::string("it does not start and the library gives no reason; check cable, "
                                           "power and the configuration's name")),
      drained.count > 0 ? meaningOf(drained.first.code).trouble : DeviceTrouble::not_there);
}

void HdSession::close() noexcept {
  if (!open_) return;
  open_ = false;
  hd_.make_current_device(id_);
  hd_.disable_device(id_);
}

HdDescription describe(const HdFunctions& hd) {
  HdDescription description;
  DeviceCapabilities& can = description.capabilities;
  can.model = text(hd, hd::kModel);
  can.serial = text(hd, hd::kSerialNumber);
  HdErrors().drain(hd);  // a missing string is no error
  if (can.model.empty()) can.model = "unnamed Phantom";
  can.provenance = Provenance::vendor_library;
  can.has_motors = true;

  description.calibration_styles = static_cast<hd::Enum>(integer(hd, hd::kCalibrationStyle, 0));
  const HdModel model = modelNamed(can.model);
  can.arm_model = model.arm_model;
  can.has_orientation = integer(hd, hd::kInputDof, 6) >= 6;
  can.has_inkwell = (description.calibration_styles & hd::kInkwellCalibration) || model.has_inkwell;
  can.has_deadman = model.has_deadman;

  can.peak_force_N = number(hd, hd::kNominalMaxForce, 0.0);
  if (!(can.peak_force_N > 0.0 && can.peak_force_N < kMaxPlausibleForce_N))
    throw DeviceError("OpenHaptics, " + can.model + ": it does not report its force; update its driver from 3D Systems",
                      DeviceTrouble::no_driver);
  can.continuous_force_N =
      std::min(number(hd, hd::kNominalMaxContinuousForce, 0.25 * can.peak_force_N), can.peak_force_N);
  if (model.geometry) can.peak_joint_torque_Nmm = glm::dvec3(model.is_omni ? kJointTorqueInUse_Nmm : 0.0);
  can.max_stiffness_N_per_mm = std::min(number(hd, hd::kNominalMaxStiffness, 0.4), kMaxStiffness_N_per_mm);
  can.max_damping_Ns_per_mm = std::min(number(hd, hd::kNominalMaxDamping, 0.004), kMaxDamping_Ns_per_mm);
  can.min_rate_Hz = 500.0;
  can.max_rate_Hz = std::max(1000.0, static_cast<double>(integer(hd, hd::kUpdateRate, 1000)));
  if (!readWorkspace(hd, hd::kUsableWorkspace, can.workspace)) readWorkspace(hd, hd::kMaxWorkspace, can.workspace);
  return description;
}

}  // namespace haptics
