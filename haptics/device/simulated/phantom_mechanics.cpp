#include "haptics/device/simulated/phantom_mechanics.h"

#include <algorithm>

#include "calibration/arm/phantom_models.h"

namespace haptics {
namespace {

using namespace calibration;

constexpr Point<Device> kBelow_D = {{0.0, -70.0, -80.0}};  // in front of its foot, without an inkwell (assumed)

/// Common to all. Gimbal: 2048 levels a turn, 11 bits without noise for its range (assumed). Velocity filter, 50 Hz,
/// and viscous friction (assumed).
PhantomMechanics phantomArm(double counts_per_turn) {
  PhantomMechanics m;
  m.sensing = {counts_per_turn, 2048.0, 50.0};
  m.viscous_Ns_per_mm = 0.0005;
  m.max_damping_Ns_per_mm = 0.005;
  return m;
}

PhantomMechanics omni() {
  PhantomMechanics m = phantomArm(15'200.0);  // 0.055 mm at 133.35 mm
  m.key = "omni", m.name = "Phantom Omni", m.geometry = kOmniGeometry;
  m.mass_kg = 0.045, m.dry_N = 0.26, m.latency_ticks = 1;
  m.peak_force_N = 3.3, m.peak_joint_Nmm = 350.0, m.continuous_force_N = 0.88;
  m.rest_D = kOmniInkwell_D, m.has_inkwell = true;
  m.max_stiffness_N_per_mm = 0.7;
  m.workspace = {{-215.0, -112.0, -123.0}, {215.0, 203.0, 95.0}};
  return m;
}

PhantomMechanics touch() {
  PhantomMechanics m = omni();
  m.key = "touch", m.name = "Touch";
  m.max_stiffness_N_per_mm = 0.4, m.max_damping_Ns_per_mm = 0.004;
  return m;
}

/// Calibrates itself while it moves; a switch in its handle. Joint torque (assumed): the Omni's, by their peak forces.
PhantomMechanics desktop() {
  PhantomMechanics m = phantomArm(36'400.0);  // 0.023 mm at 133.35 mm
  m.key = "desktop", m.name = "Phantom Desktop", m.geometry = kDesktopGeometry;
  m.mass_kg = 0.045, m.dry_N = 0.06, m.latency_ticks = 1;
  m.peak_force_N = 7.9, m.peak_joint_Nmm = 350.0 * 7.9 / 3.3, m.continuous_force_N = 1.75;
  m.rest_D = kBelow_D, m.has_deadman = true;
  m.max_stiffness_N_per_mm = 1.0;
  m.workspace = {{-80.0, -60.0, -60.0}, {80.0, 60.0, 60.0}};
  return m;
}

/// Joint torque (assumed): what gives its peak force there. On the computer's own bus, so no latency.
PhantomMechanics premium() {
  PhantomMechanics m = phantomArm(43'900.0);  // 0.03 mm at 209.55 mm
  m.key = "premium", m.name = "Phantom Premium 1.5", m.geometry = kPremium15Geometry;
  m.mass_kg = 0.075, m.dry_N = 0.04;
  m.peak_force_N = 8.5, m.peak_joint_Nmm = 8.5 * 209.55, m.continuous_force_N = 1.4;
  m.rest_D = kBelow_D;
  m.max_stiffness_N_per_mm = 0.8;
  m.workspace = {{-190.5, -133.5, -95.5}, {190.5, 133.5, 95.5}};
  return m;
}

}  // namespace

Pose<Device, Handle> PhantomMechanics::rest_DH() const {
  return handlePose(geometry, {armAnglesFor(geometry, rest_D).value_or(glm::dvec3(0.0)), glm::dvec3(0.0)});
}

const std::array<PhantomMechanics, 4>& simulatedPhantoms() {
  static const std::array<PhantomMechanics, 4> kAll = {omni(), touch(), desktop(), premium()};
  return kAll;
}

const PhantomMechanics* findSimulatedPhantom(std::string_view key) {
  const auto found = std::ranges::find(simulatedPhantoms(), key, &PhantomMechanics::key);
  return found == simulatedPhantoms().end() ? nullptr : &*found;
}

}  // namespace haptics
