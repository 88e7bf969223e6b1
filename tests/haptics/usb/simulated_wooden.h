// A WoodenHaptics behind the simulated bus: the mbed firmware's loop (a report for every report), its 0.5 s watchdog,
// and an arm in a viscous hand that its currents move. Written from the published facts, independently of the driver:
// joint angles, capstans, forward kinematics. Everything under the bus's lock.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "calibration/geometry/pose.h"
#include "tests/haptics/usb/simulated_usb.h"

namespace simulated_usb {

class SimulatedWooden : public Device {
 public:
  static Description description();

  void onOut(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, double t_s) override;
  std::optional<Bytes> onIn(std::uint8_t endpoint, double t_s) override;

  void onTime(double t_s) override { move(t_s); }

  /// Holds the joints there until let go.
  void hold(const glm::dvec3& joints_rad) { joints_rad_ = joints_rad, held_ = true; }
  void holdAtHome();
  /// Rotates the held turret at a constant rate.
  void swing(double rad_per_s) { swing_rad_per_s_ = rad_per_s; }
  void letGo() { held_ = false; }
  void pressSwitch() { switch_pressed_ = true; }
  glm::dvec3 position_mm() const;

  // Build and behaviour. Power-up offset: of the counters against the true joints.
  glm::dvec3 motor_Nmm_per_A{321.0, 60.3, 60.3};
  std::array<int, 3> offset_counts{1234, -777, 345};
  std::function<void(Bytes&)> spoil;  ///< corrupts a report
  bool button = false;

  // Record.
  std::vector<std::array<std::int16_t, 7>> received;
  int largest_mA = 0, watchdog_trips = 0, presets = 0;
  bool enabled = false;
  std::array<std::int16_t, 3> mA{};

 private:
  void move(double t_s);
  std::array<int, 3> trueCounts() const;

  glm::dvec3 joints_rad_{0.0, 0.35, 0.65}, rate_rad_per_s_{0.0};
  double swing_rad_per_s_ = 0.0;
  bool held_ = true, switch_pressed_ = false, reports_ = false;
  double last_out_s_ = 0.0, last_move_s_ = 0.0, next_report_s_ = 0.0;
};

}  // namespace simulated_usb
