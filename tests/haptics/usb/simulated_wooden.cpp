#include "tests/haptics/usb/simulated_wooden.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace simulated_usb {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kWatchdog_s = 0.5, kFrame_s = 1e-3;
/// 0.1 kg a forearm away, in a hand as viscous as stops it within 50 ms.
constexpr double kInertia_Nmm_s2 = 4.8, kFriction_Nmm_s = 96.0;
constexpr std::array<double, 3> kTurnsOfTheMotor = {16.0, 12.0, 12.0};  ///< for one of the body
constexpr double kCountsPerTurn = 2000.0;

}  // namespace

Description SimulatedWooden::description() {
  Description d;
  d.vendor = 0x1234;
  d.product = 0x0006;
  d.maker = "mbed.org";
  d.name = "HID DEVICE";
  d.serial = "0123456789";
  return d;
}

void SimulatedWooden::holdAtHome() { hold({0.0, 0.0, 0.5 * kPi}); }

glm::dvec3 SimulatedWooden::position_mm() const {
  const double a = joints_rad_.x, b = joints_rad_.y, c = joints_rad_.z;
  return {std::cos(a) * (205.0 * std::sin(b) + 245.0 * std::sin(c)) - 220.0,
          std::sin(a) * (205.0 * std::sin(b) + 245.0 * std::sin(c)),
          80.0 + 205.0 * std::cos(b) - 245.0 * std::cos(c) - 80.0};
}

std::array<int, 3> SimulatedWooden::trueCounts() const {
  std::array<int, 3> counts{};
  for (int i = 0; i < 3; ++i)
    counts[static_cast<std::size_t>(i)] = static_cast<int>(
        std::lround(joints_rad_[i] / (2.0 * kPi) * kTurnsOfTheMotor[static_cast<std::size_t>(i)] * kCountsPerTurn));
  return counts;
}

void SimulatedWooden::move(double t_s) {
  if (enabled && t_s - last_out_s_ > kWatchdog_s) {
    enabled = false;
    mA = {};
    ++watchdog_trips;
  }
  const double step_s = 2.5e-4;
  last_move_s_ = std::max(last_move_s_, t_s - 0.1);
  for (; last_move_s_ + step_s <= t_s; last_move_s_ += step_s) {
    if (held_) {
      rate_rad_per_s_ = glm::dvec3(0.0);
      joints_rad_.x += step_s * swing_rad_per_s_;
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const double torque_Nmm = 1e-3 * mA[n] * motor_Nmm_per_A[i] * kTurnsOfTheMotor[n];
      rate_rad_per_s_[i] += step_s * (torque_Nmm - kFriction_Nmm_s * rate_rad_per_s_[i]) / kInertia_Nmm_s2;
      joints_rad_[i] = std::clamp(joints_rad_[i] + step_s * rate_rad_per_s_[i], -1.2, 1.6);
    }
  }
}

void SimulatedWooden::onOut(std::uint8_t, std::span<const std::uint8_t> bytes, double t_s) {
  move(t_s);
  std::array<std::int16_t, 7> words{};
  if (bytes.size() != sizeof words) return;
  std::memcpy(words.data(), bytes.data(), sizeof words);
  received.push_back(words);
  last_out_s_ = t_s;
  enabled = reports_ = true;
  mA = {};
  if (words[3] == 1) {
    const std::array<int, 3> counts = trueCounts();
    for (std::size_t i = 0; i < 3; ++i) offset_counts[i] = words[4 + i] - counts[i];
    switch_pressed_ = false;
    ++presets;
  } else {
    mA = {words[0], words[1], words[2]};
    for (std::int16_t each : mA) largest_mA = std::max(largest_mA, std::abs(each));
  }
}

std::optional<Bytes> SimulatedWooden::onIn(std::uint8_t, double t_s) {
  move(t_s);
  if (!reports_ || t_s < next_report_s_) return {};
  reports_ = false;
  next_report_s_ = t_s + kFrame_s;
  const std::array<int, 3> counts = trueCounts();
  std::array<std::int16_t, 7> words{};
  for (std::size_t i = 0; i < 3; ++i) words[i] = static_cast<std::int16_t>(counts[i] + offset_counts[i]);
  if (button) words[3] = 10'000;
  words[6] = switch_pressed_ ? 1 : 0;
  Bytes bytes(sizeof words);
  std::memcpy(bytes.data(), words.data(), sizeof words);
  if (spoil) spoil(bytes);
  return bytes;
}

}  // namespace simulated_usb
